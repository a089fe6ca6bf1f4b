#version 330
// What living skin is like at a pixel; skin/light.frag is the light on it.
#include "common/brow.glsl"
uniform sampler2D strands;
in vec4 v_normal;
in vec4 v_paint;
in vec4 v_map;
in vec4 v_state;
layout(location = 0) out vec4 normal;  // and curvature [1/m]
layout(location = 1) out vec4 paint;   // hidden, lips, covered by hair, blood
layout(location = 2) out float distance_;
layout(location = 3) out vec2 place_in_map;
layout(location = 4) out vec4 state;   // amplitude of both fine fields, of pores, and the value shown

void main() {
    float brow = brow_cover(v_paint.z, v_state.w, strands);
    vec3 n = normalize(v_normal.xyz);
    normal = vec4(gl_FrontFacing ? n : -n, v_normal.w);
    // The inside of the skin, seen through an open mouth, is dark.
    paint = vec4(gl_FrontFacing ? v_paint.x : max(v_paint.x, 0.96), v_paint.y, max(brow, smoothstep(0.0, 1.0, v_map.w)), v_paint.w);
    distance_ = 1.0 / gl_FragCoord.w;
    place_in_map = v_map.xy;
    // Fine wrinkles fade out towards the border of their map, so that it does not show.
    float inside = smoothstep(0.0, 1.0, v_map.z);
    state = vec4(v_state.xy * inside, inside, v_state.z);
}
