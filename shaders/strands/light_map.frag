#version 330
// The part of the light that comes through all of the hair, for the skin below it.
#include "common/deep_opacity.glsl"
out float light;

void main() {
    light = exp(-all_hair(gl_FragCoord.xy / vec2(textureSize(far_counts, 0))));
}
