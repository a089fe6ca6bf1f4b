#version 330
// The light that reaches each particle of a batch: past the objects, through the hair drawn so far, and through the
// particles of its own batch that stand nearer to the light.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/strands.glsl"
#include "common/billboards.glsl"
uniform int first;
uniform int rows;
flat out vec2 v_light;

// Particles may lie this far [m] under the surface, as hair roots do, without being in its shadow.
const float root_bias = 0.018;

float past_objects_at(vec2 texel, float depth) {
    float size = float(textureSize(light_map, 0).x);
    vec3 at = vec3(texel / size, depth - root_bias / shadow.y);
    float lit = 0.0;
    for (int k = 0; k < 8; ++k) lit += textureLod(shadow_map, vec3(at.xy + disc[k] * 0.006 / shadow.y, at.z), 0.0);
    return lit / 8.0;
}

void main() {
    int rank = gl_VertexID;
    vec4 where = billboard(rank, 0);
    vec2 last = billboard(rank, 2).xy;
    vec2 pixel = floor(where.xy) + 0.5;
    float lit = past_objects_at(where.xy, last.x);
    float through = texelFetch(light_map, ivec2(where.xy), 0).r;
    for (int j = first; j < rank; ++j) {
        vec4 a = billboard(j, 0);
        vec4 b = billboard(j, 1);
        vec2 off = pixel - a.xy;
        vec2 local = vec2(off.x * a.w - off.y * a.z, dot(off, a.zw)) / b.xy;
        if (max(abs(local.x), abs(local.y)) < 1.0) through *= 1.0 - light_opacity(local, b.w) * b.z;
    }
    v_light = vec2(lit * through, lit);
    int particle = int(last.y + 0.5);
    vec2 at = (vec2(particle % row, particle / row) + 0.5) / vec2(row, rows);
    gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
