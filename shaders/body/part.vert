#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in vec3 normal;
in vec2 paint;
out vec3 v_place;
out vec3 v_rest;
out vec3 v_normal;
out vec2 v_paint;  // hidden by the skin; 0 at the root of a lash, 1 at its tip

// Parts are rigid with the head.
void main() {
    v_place = turned(position, head_turn.xyz) + head_shift.xyz;
    v_rest = position;
    v_paint = paint;
    v_normal = turned(normal, head_turn.xyz);
    gl_Position = clip_from_world * vec4(v_place, 1.0);
}
