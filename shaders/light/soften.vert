#version 330
// Light averaged over linked particles: towards the root, at the particle, towards the tip.
#include "common/particles.glsl"
uniform sampler2D neighbours;  // per particle: `slots` / 2 texels of rootward ones, as many of tipward ones
uniform sampler2D received;
uniform int slots;
uniform int rows;
flat out vec4 v_light;

// Sum of the light of four neighbours, and how many there are.
vec2 sum_of(vec4 who) {
    vec2 sum = vec2(0.0);
    for (int k = 0; k < 4; ++k) {
        if (who[k] >= 0.0) sum += vec2(record(received, int(who[k] + 0.5), 1, 0).r, 1.0);
    }
    return sum;
}

// Half of what a particle gets, half of what its neighbours in texels from..to get.
float shared(int particle, float own, int from, int to) {
    vec2 sum = vec2(0.0);
    for (int k = from; k < to; ++k) sum += sum_of(record(neighbours, particle, slots, k));
    return sum.y > 0.0 ? 0.5 * (own + sum.x / sum.y) : own;
}

void main() {
    int particle = gl_VertexID;
    float own = record(received, particle, 1, 0).r;
    float rootward = shared(particle, own, 0, slots / 2);
    float tipward = shared(particle, own, slots / 2, slots);
    v_light = vec4(rootward, 0.5 * (rootward + tipward), tipward, 1.0);
    gl_PointSize = 1.0;
    gl_Position = place_of(particle, rows);
}
