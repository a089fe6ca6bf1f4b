#version 330
// What living skin is like at a pixel; skin/light.frag is the light on it.
uniform sampler2D strands;
uniform float creases;   // strength of the shade in creases
uniform float wrinkled;  // 0 where fine wrinkles are left out
in float v_distance;  // from the eye, along its gaze [m]
in float v_stroke;
in vec3 v_normal;
in vec4 v_paint;
in float v_cover;
in vec2 v_uv;
in vec2 v_body;
in vec4 v_state;
layout(location = 0) out vec4 normal;  // and curvature [1/m]
layout(location = 1) out vec4 paint;   // hidden, lips, covered by hair, flush
layout(location = 2) out float distance_;
layout(location = 3) out vec2 place_in_map;
layout(location = 4) out vec4 state;   // amplitude of both fine fields, of pores, and the value shown

void main() {
    // Brow hairs lie outwards and up: fine strokes, not a stain.
    float stroke = textureLod(strands, vec2(v_stroke, 0.5), 0.0).r;
    float brow = smoothstep(0.2, 0.8, v_paint.z * (0.9 + 0.4 * stroke)) * 0.9;
    vec3 n = normalize(v_normal);
    normal = vec4(gl_FrontFacing ? n : -n, v_body.x);
    float open = (1.0 - v_paint.x) * max(1.0 - creases * v_state.z, 0.0);
    paint = vec4(1.0 - open, v_paint.y, max(brow, smoothstep(0.0, 1.0, v_cover)), v_paint.w);
    distance_ = v_distance;
    place_in_map = v_uv;
    // Fine wrinkles fade out towards the border of their map, so that it does not show.
    float inside = smoothstep(0.0, 1.0, v_body.y) * wrinkled;
    state = vec4(v_state.xy * inside, inside, v_state.w);
}
