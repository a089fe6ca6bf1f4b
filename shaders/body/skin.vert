#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in vec3 normal;
in float head_weight;
in vec4 paint;
in float cover;
out float v_distance;
out vec3 v_rest;
out vec3 v_normal;
out vec4 v_paint;
out float v_cover;

void main() {
    vec3 turn = head_turn.xyz * head_weight;
    vec3 place = turned(position, turn) + head_shift.xyz;
    v_rest = position;
    v_normal = turned(normal, turn);
    v_paint = paint;
    v_cover = cover;
    gl_Position = clip_from_world * vec4(place, 1.0);
    v_distance = gl_Position.w;
}
