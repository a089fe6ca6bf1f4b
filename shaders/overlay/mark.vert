#version 330
#include "common/scene.glsl"
in vec3 position;
in vec3 mark_colour;
out vec3 v_colour;

void main() {
    v_colour = mark_colour;
    gl_PointSize = 3.0;
    gl_Position = clip_from_world * vec4(position, 1.0);
}
