#version 330
// Adds a strand to the count of every depth that lies behind it.
uniform sampler2D front;
uniform vec4 near_depths;
uniform vec4 far_depths;
in float v_cover;
in float v_depth;
layout(location = 0) out vec4 near_counts;
layout(location = 1) out vec4 far_counts;

void main() {
    vec4 depth = vec4(v_depth - texelFetch(front, ivec2(gl_FragCoord.xy), 0).r);
    near_counts = v_cover * step(depth, near_depths);
    far_counts = v_cover * step(depth, vec4(far_depths.xyz, 2.0));
}
