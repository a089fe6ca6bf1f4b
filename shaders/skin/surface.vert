#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in vec3 normal;
in vec4 state;    // amplitude of both fine fields; hidden by creases; the value shown
in vec3 rest;     // at rest, since paint stays where it is on the skin
in vec2 uv;
in vec3 body;     // how far it turns with the head; curvature [1/m]; how far inside the map
in vec4 paint;
in float cover;
out float v_distance;
out float v_stroke;  // across the hairs of the brows
out vec3 v_normal;
out vec4 v_paint;  // hidden, lips, brows, flush
out float v_cover;  // how densely hair stands
out vec2 v_uv;
out vec2 v_body;  // curvature, mapped
out vec4 v_state;

void main() {
    vec3 turn = head_turn.xyz * body.x;
    vec3 place = turned(position, turn) + head_shift.xyz;
    v_stroke = 9.0 * (0.6 * abs(rest.x) - 0.8 * rest.y);
    v_normal = turned(normal, turn);
    v_paint = paint;
    v_cover = cover;
    v_uv = uv;
    v_body = body.yz;
    v_state = state;
    gl_Position = clip_from_world * vec4(place, 1.0);
    v_distance = gl_Position.w;
}
