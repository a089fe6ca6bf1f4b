#version 330
// What the skin is like at a pixel; light.frag is the light on it.
#include "common/strands.glsl"
in float v_distance;  // from the eye, along its gaze [m]
in vec3 v_rest;
in vec3 v_normal;
in vec4 v_paint;  // occlusion, lips, brows, flush
in float v_cover;  // how densely hair stands
layout(location = 0) out vec4 normal;  // and how much of the ground hair covers
layout(location = 1) out vec4 paint;   // occlusion, lips, brows, flush
layout(location = 2) out float distance_;

void main() {
    // Brow hairs lie outwards and up: fine strokes, not a stain.
    float stroke = textureLod(strands, vec2(9.0 * (0.6 * abs(v_rest.x) - 0.8 * v_rest.y), 0.5), 0.0).r;
    float brow = smoothstep(0.2, 0.8, v_paint.z * (0.9 + 0.4 * stroke)) * 0.9;
    vec3 n = normalize(v_normal);
    normal = vec4(gl_FrontFacing ? n : -n, smoothstep(0.0, 1.0, v_cover));
    paint = vec4(v_paint.xy, brow, v_paint.w);
    distance_ = v_distance;
}
