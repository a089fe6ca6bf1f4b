#version 330
// What the skin is like at a pixel; light.frag is the light on it.
#include "common/brow.glsl"
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
    float brow = brow_cover(v_paint.z, across_brow(v_rest), strands);
    vec3 n = normalize(v_normal);
    normal = vec4(gl_FrontFacing ? n : -n, smoothstep(0.0, 1.0, v_cover));
    paint = vec4(v_paint.xy, brow, v_paint.w);
    distance_ = v_distance;
}
