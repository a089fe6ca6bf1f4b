#version 330
#include "common/scene.glsl"
in vec3 position;

void main() {
    gl_Position = light_from_world * vec4(position, 1.0);
}
