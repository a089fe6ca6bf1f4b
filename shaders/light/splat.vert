#version 330
// A billboard into the light map. Particles in the shadow of the objects take no light from anyone.
#include "common/particles.glsl"
uniform sampler2D billboards;
uniform sampler2D reach;
uniform int first;
uniform float map_size;
in vec2 corner;
out vec2 v_local;
flat out vec2 v_window;
flat out float v_opacity;

void main() {
    int rank = first + gl_InstanceID;
    vec4 a = record(billboards, rank, 3, 0);
    vec4 b = record(billboards, rank, 3, 1);
    vec4 c = record(billboards, rank, 3, 2);
    v_local = corner;
    v_window = vec2(b.w, c.z);
    v_opacity = b.z * record(reach, rank, 1, 0).r;
    vec2 across = vec2(a.w, -a.z);
    vec2 texel = a.xy + across * corner.x * b.x + a.zw * corner.y * b.y;
    gl_Position = vec4(texel / map_size * 2.0 - 1.0, v_opacity > 0.0 ? 0.0 : 2.0, 1.0);
}
