#version 330
// The part of the light that comes through the hair in front of the skin.
#include "common/deep_opacity.glsl"
uniform sampler2D body;         // depth, as the light sees the body
uniform mat4 hair_box_from_light;
uniform float size;             // texels of the map drawn into
out float light;

void main() {
    vec2 at = gl_FragCoord.xy / size;
    vec3 seen = vec3(at, textureLod(body, at, 0.0).r) * 2.0 - 1.0;
    light = exp(-hair_crossed((hair_box_from_light * vec4(seen, 1.0)).xyz * 0.5 + 0.5));
}
