#version 330
#include "common/strands.glsl"
in vec2 v_local;
flat in float v_window;
flat in float v_opacity;
out vec4 transmitted;

void main() {
    transmitted = vec4(1.0 - light_opacity(v_local, v_window) * v_opacity);
}
