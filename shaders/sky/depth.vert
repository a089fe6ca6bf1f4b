#version 330
uniform mat4 map_from_world;
in vec3 position;

void main() {
    gl_Position = map_from_world * vec4(position, 1.0);
}
