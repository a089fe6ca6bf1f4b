#version 330
// The part of the light that comes past the objects to each particle, nearest to the light first.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/particles.glsl"
uniform sampler2D billboards;  // BILLBOARD_DTYPE of render/light_billboards.py
uniform float map_size;
uniform int rows;
flat out vec4 v_light;

// Particles may lie this far [m] under the surface, as hair roots do, without being in its shadow.
const float root_bias = 0.018;

void main() {
    vec2 place = record(billboards, gl_VertexID, 3, 0).xy / map_size;
    float depth = record(billboards, gl_VertexID, 3, 2).x;
    v_light = vec4(past_objects_at(vec3(place, depth - root_bias / shadow.y), 0.006));
    gl_PointSize = 1.0;
    gl_Position = place_of(gl_VertexID, rows);
}
