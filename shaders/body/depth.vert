#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
in vec3 position;
in float head_weight;

void main() {
    vec3 place = turned(position, head_turn.xyz * head_weight) + head_shift.xyz;
    gl_Position = light_from_world * vec4(place, 1.0);
}
