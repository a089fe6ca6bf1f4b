#version 330
// Strands as a light sees them: at least a texel wide, with as much opacity as their true width covers.
#include "common/strand_points.glsl"
uniform mat4 map_from_head;
uniform float texels_per_metre;  // of the map drawn into
uniform float size;              // texels a side
uniform float widening;
out float v_cover;
out float v_depth;

void main() {
    ivec2 texel = texel_of(gl_VertexID / 2);
    float side = float(gl_VertexID % 2) * 2.0 - 1.0;
    vec4 point = texelFetch(points, texel, 0);
    vec4 place = map_from_head * vec4(point.xyz, 1.0);
    vec2 along = (map_from_head * vec4(texelFetch(tangents, texel, 0).xyz, 0.0)).xy;
    vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-9);
    float half_width = point.w * widening * texels_per_metre;
    float drawn = max(half_width, 0.5);
    v_cover = half_width / drawn;
    gl_Position = vec4(place.xy + across * (side * drawn * 2.0 / size), place.zw);
    v_depth = gl_Position.z * 0.5 + 0.5;
}
