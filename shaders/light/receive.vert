#version 330
// The light that reaches each particle of a batch: past the objects, through the hair drawn so far, and through the
// particles of its own batch that stand nearer to the light.
#include "common/strands.glsl"
#include "common/particles.glsl"
uniform sampler2D billboards;  // BILLBOARD_DTYPE of render/light_billboards.py, nearest to the light first
uniform sampler2D reach;       // of each, past the objects
uniform sampler2D light_map;
uniform int first;
uniform int rows;
flat out vec4 v_light;

void main() {
    int rank = gl_VertexID;
    vec4 here = record(billboards, rank, 3, 0);
    vec4 last = record(billboards, rank, 3, 2);
    float lit = record(reach, rank, 1, 0).r;
    float through = texelFetch(light_map, ivec2(here.xy), 0).r;
    vec2 pixel = floor(here.xy) + 0.5;
    for (int j = first; j < rank; ++j) {
        vec4 a = record(billboards, j, 3, 0);
        vec4 b = record(billboards, j, 3, 1);
        vec2 off = pixel - a.xy;
        vec2 local = vec2(off.x * a.w - off.y * a.z, dot(off, a.zw)) / b.xy;
        if (max(abs(local.x), abs(local.y)) < 1.0) {
            vec4 c = record(billboards, j, 3, 2);
            through *= 1.0 - light_opacity(local, b.w, c.z) * b.z * record(reach, j, 1, 0).r;
        }
    }
    v_light = vec4(lit * through, lit, 0.0, 0.0);
    gl_PointSize = 1.0;
    gl_Position = place_of(int(last.y + 0.5), rows);
}
