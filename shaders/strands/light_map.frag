#version 330
// The part of the light that comes through the hair in front of the skin.
#include "common/deep_opacity.glsl"
uniform sampler2D body;  // depth
out float light;

void main() {
    vec2 at = gl_FragCoord.xy / vec2(textureSize(far_counts, 0));
    light = exp(-hair_crossed(vec3(at, textureLod(body, at, 0.0).r)));
}
