#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in vec3 normal;
in vec3 tint;
out vec3 v_place;
out vec3 v_normal;
out vec3 v_tint;

// What is worn in the hair is rigid with the head.
void main() {
    v_place = turned(position, head_turn.xyz) + head_shift.xyz;
    v_normal = turned(normal, head_turn.xyz);
    v_tint = tint;
    gl_Position = clip_from_world * vec4(v_place, 1.0);
}
