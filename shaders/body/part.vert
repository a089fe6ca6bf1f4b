#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in vec3 normal;
in vec4 paint;
out vec3 v_place;
out vec3 v_rest;
out vec3 v_normal;
out vec3 v_paint;  // hidden by the skin; along a row of teeth, or from the root of a lash to its tip; gum

// Parts are rigid with the head.
void main() {
    v_place = turned(position, head_turn.xyz) + head_shift.xyz;
    v_rest = position;
    v_paint = paint.xyz;
    v_normal = turned(normal, head_turn.xyz);
    gl_Position = clip_from_world * vec4(v_place, 1.0);
}
