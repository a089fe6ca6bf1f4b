#version 330
in vec3 v_radiance;
out vec4 light;  // radiance, and depth in the box

void main() {
    light = vec4(v_radiance, gl_FragCoord.z);
}
