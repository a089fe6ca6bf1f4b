#version 330
#include "common/scene.glsl"
in vec3 position;
in vec3 normal;
in vec3 soft;  // irradiance of the soft light
out vec3 v_place;
out vec3 v_normal;
out vec3 v_soft;

void main() {
    v_place = position;
    v_normal = normal;
    v_soft = soft;
    gl_Position = clip_from_world * vec4(position, 1.0);
}
