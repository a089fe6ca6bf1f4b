#version 330
flat in vec4 v_light;
out vec4 light;
void main() { light = v_light; }
