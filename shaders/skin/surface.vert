#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/brow.glsl"
uniform float creases;   // strength of the shade in creases
uniform float wrinkled;  // 0 where fine wrinkles are left out
in vec3 position;
in vec3 normal;
in vec4 state;    // amplitude of both fine fields; hidden by creases; the value shown
in vec3 rest;     // at rest, since paint stays where it is on the skin
in vec2 uv;
in vec3 body;     // how far it turns with the head; curvature [1/m]; how far inside the map
in vec4 paint;    // hidden, lips, brows, blood
in float cover;   // how densely hair stands
// Triangles are small and many: what they carry to their pixels is packed.
out vec4 v_normal;  // and curvature
out vec4 v_paint;   // hidden, lips, brows, blood
out vec4 v_map;     // place in the map, how far inside, cover
out vec4 v_state;   // amplitude of both fine fields, value shown, place across the hairs of the brows [m]

void main() {
    vec3 turn = head_turn.xyz * body.x;
    vec3 place = turned(position, turn) + head_shift.xyz;
    v_normal = vec4(turned(normal, turn), body.y);
    float open = (1.0 - paint.x) * max(1.0 - creases * state.z, 0.0);
    v_paint = vec4(1.0 - open, paint.yzw);
    v_map = vec4(uv, body.z * wrinkled, cover);
    v_state = vec4(state.xyw, across_brow(rest));
    gl_Position = clip_from_world * vec4(place, 1.0);
}
