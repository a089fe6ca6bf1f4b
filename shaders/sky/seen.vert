#version 330
// How much light from one direction of the sky meets a point: red if nothing is in the way, green if it had none.
#include "common/particles.glsl"
uniform mat4 map_from_world;
uniform vec3 direction;  // unit, to the sky
uniform float offset;    // away from the surface [m]
uniform sampler2DShadow depth_map;
uniform int rows;
in vec3 position;
in vec3 normal;
flat out vec4 v_light;

void main() {
    float facing = max(dot(normal, direction), 0.0);
    vec3 at = (map_from_world * vec4(position + offset * (normal + direction), 1.0)).xyz * 0.5 + 0.5;
    v_light = vec4(facing * textureLod(depth_map, at, 0.0), facing, 0.0, 0.0);
    gl_PointSize = 1.0;
    gl_Position = place_of(gl_VertexID, rows);
}
