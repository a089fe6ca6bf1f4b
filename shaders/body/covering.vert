#version 330
// The skin once more, to see which samples of a pixel it covers.
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in float head_weight;
out float v_distance;

void main() {
    gl_Position = clip_from_world * vec4(turned(position, head_turn.xyz * head_weight) + head_shift.xyz, 1.0);
    v_distance = gl_Position.w;
}
