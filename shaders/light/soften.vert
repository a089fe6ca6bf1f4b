#version 330
// Light averaged over linked particles: towards the root, at the particle, towards the tip.
#include "common/particles.glsl"
uniform sampler2D neighbours;  // per particle: `slots` / 2 texels of rootward ones, as many of tipward ones
uniform sampler2D received;
uniform int slots;
uniform int rows;
flat out vec4 v_light;

float light_of(int particle) { return record(received, particle, 1, 0).r; }

float mean_over(int particle, int from, int to) {
    float sum = 0.0;
    for (int k = from; k < to; ++k) {
        ivec4 who = ivec4(record(neighbours, particle, slots, k) + 0.5);
        sum += light_of(who.x) + light_of(who.y) + light_of(who.z) + light_of(who.w);
    }
    return sum / float(4 * (to - from));
}

void main() {
    int particle = gl_VertexID;
    float own = light_of(particle);
    float rootward = mix(own, mean_over(particle, 0, slots / 2), 0.75);
    float tipward = mix(own, mean_over(particle, slots / 2, slots), 0.75);
    v_light = vec4(rootward, 0.4 * own + 0.3 * (rootward + tipward), tipward, 1.0);
    gl_PointSize = 1.0;
    gl_Position = place_of(particle, rows);
}
