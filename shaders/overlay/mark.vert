#version 330
#include "common/scene.glsl"
in vec3 position;
in vec4 mark_colour;
out vec4 v_colour;

void main() {
    v_colour = mark_colour;
    gl_PointSize = 3.0;
    gl_Position = clip_from_world * vec4(position, 1.0);
}
