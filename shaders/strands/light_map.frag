#version 330
// The part of the light that comes through the hair in front of the skin.
#include "common/deep_opacity.glsl"
uniform sampler2D body;         // depth, as the light sees the body
uniform mat4 hair_box_from_light;
uniform float size;             // texels of the map drawn into
out float light;

const float rim = 4.0;  // texels; who reads the map reads no farther beside the body

float depth_at(vec2 texel) {
    return textureLod(body, texel / size, 0.0).r;
}

void main() {
    vec2 at = gl_FragCoord.xy;
    float depth = depth_at(at);
    light = 1.0;
    // Most of the map shows nobody, and nothing there is ever read.
    if (min(depth, min(min(depth_at(at + vec2(rim)), depth_at(at - vec2(rim))),
                       min(depth_at(at + vec2(rim, -rim)), depth_at(at + vec2(-rim, rim))))) >= 1.0) return;
    vec3 seen = vec3(at / size, depth) * 2.0 - 1.0;
    light = past_hair((hair_box_from_light * vec4(seen, 1.0)).xyz * 0.5 + 0.5);
}
