#version 330
// The body with the light it sends back, as seen from one direction of the sky.
uniform mat4 map_from_head;
in vec3 position;
in vec3 radiance;
out vec3 v_radiance;

void main() {
    v_radiance = radiance;
    gl_Position = map_from_head * vec4(position, 1.0);
}
