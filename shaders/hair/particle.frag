#version 330
flat in vec2 v_light;
out vec2 light;
void main() { light = v_light; }
