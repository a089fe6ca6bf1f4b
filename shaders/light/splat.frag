#version 330
#include "common/strands.glsl"
in vec2 v_local;
flat in vec2 v_window;  // place and width
flat in float v_opacity;
out vec4 transmitted;

void main() {
    transmitted = vec4(1.0 - light_opacity(v_local, v_window.x, v_window.y) * v_opacity);
}
