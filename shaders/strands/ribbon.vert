#version 330
// A strand as a ribbon that faces the eye, pulled out of the textures of its points.
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/strand_points.glsl"
uniform sampler2D shades;
uniform float metres_per_pixel;  // at distance 1 [m]
uniform float widening;
uniform float room;              // [pixels]
out vec3 v_colour;
out float v_across;              // from the middle of the strand [pixels]
flat out float v_half_width;     // [pixels]

void main() {
    ivec2 texel = texel_of(gl_VertexID / 2);
    float side = float(gl_VertexID % 2) * 2.0 - 1.0;
    vec4 point = texelFetch(points, texel, 0);
    vec3 place = turned(point.xyz, head_turn.xyz) + head_shift.xyz;
    vec3 along = turned(texelFetch(tangents, texel, 0).xyz, head_turn.xyz);
    vec3 across = normalize(cross(along, eye.xyz - place));
    vec4 middle = clip_from_world * vec4(place, 1.0);
    float pixel = metres_per_pixel * middle.w;
    float half_width = point.w * widening;
    float drawn = half_width + room * pixel;  // for a soft edge
    v_colour = texelFetch(shades, texel, 0).rgb;
    v_across = side * drawn / pixel;
    v_half_width = half_width / pixel;
    gl_Position = clip_from_world * vec4(place + across * (side * drawn), 1.0);
}
