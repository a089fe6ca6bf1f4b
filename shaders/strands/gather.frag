#version 330
// The light that comes to a place from all sides: past the body, through the hair, and from the body back.
// For red, green and blue the mean radiance, its slope and its bend: radiance from direction d is about
// mean + dot(slope, d) + dot(d, bend * d), bend being symmetric and without trace (render/soft_light.py).
#include "common/deep_opacity.glsl"
#include "common/pile.glsl"
#include "common/through_hair.glsl"
uniform sampler2D receivers;   // places in the head frame [m]
uniform sampler2D directions;  // right, up, towards the sky, and 9 weights, for every direction; 2 k and 2 k + 1 are opposite
uniform sampler2D body;        // radiance and depth, as seen from every direction
uniform sampler2D far_body;    // and of the last that faces there: what lies under an overhang
uniform int tiles;
uniform vec4 body_sphere;      // centre and radius [m] of what the views of the body show
uniform vec4 hair_sphere;      // and of those of the hair
uniform float filling;
uniform vec3 sky_above;
uniform vec3 sky_below;
uniform vec3 upward;           // in the head frame
uniform float bias;            // [m]
uniform float clear;           // so near to a place there is no strand [m]
layout(location = 0) out vec4 red;  // mean and slope
layout(location = 1) out vec4 green;
layout(location = 2) out vec4 blue;
layout(location = 3) out vec4 red_bend;
layout(location = 4) out vec4 green_bend;
layout(location = 5) out vec4 blue_bend;
layout(location = 6) out vec4 last_bend;  // of red, green and blue
layout(location = 7) out vec4 hair;       // mean and slope of how much of it there is

// What light from one direction adds to all of them.
struct Weights {
    vec4 first;
    vec4 bend;
    float last;
};

Weights weights_of(int k) {
    vec3 a = texelFetch(directions, ivec2(3, k), 0).xyz, b = texelFetch(directions, ivec2(4, k), 0).xyz,
         c = texelFetch(directions, ivec2(5, k), 0).xyz;
    return Weights(vec4(a, b.x), vec4(b.yz, c.xy), c.z);
}

void add(vec3 light, Weights of) {
    red += light.r * of.first;
    green += light.g * of.first;
    blue += light.b * of.first;
    red_bend += light.r * of.bend;
    green_bend += light.g * of.bend;
    blue_bend += light.b * of.bend;
    last_bend.rgb += light * of.last;
}

// In the box of view k, 0 to 1.
vec3 box_of(int k, vec4 sphere, vec3 place) {
    vec3 from = (place - sphere.xyz) / sphere.w;
    return 0.5 + 0.5 * vec3(dot(texelFetch(directions, ivec2(0, k), 0).xyz, from),
                            dot(texelFetch(directions, ivec2(1, k), 0).xyz, from),
                            -dot(texelFetch(directions, ivec2(2, k), 0).xyz, from));
}

vec3 in_texture(int k, vec3 at) {
    return vec3((at.xy + vec2(k % tiles, k / tiles)) / float(tiles), at.z);
}

bool inside(vec2 at) {
    return all(greaterThanEqual(at, vec2(0.0))) && all(lessThanEqual(at, vec2(1.0)));
}

// How much hair there is, from 0 to 1 (common/soft_light.glsl).
float filled(Crossed crossed) {
    float count = dot(crossed.counts, crossed.shares);
    return filling * count / (1.0 + filling * count);
}

// Radiance of the body and its depth, as seen in view k along the line through a place; far away where there is none.
vec4 body_by(sampler2D seen, int k, vec3 at) {
    return inside(at.xy) ? textureLod(seen, in_texture(k, at).xy, 0.0) : vec4(0.0, 0.0, 0.0, 1e9);
}

void main() {
    vec3 place = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz;
    red = green = blue = red_bend = green_bend = blue_bend = last_bend = hair = vec4(0.0);
    float hidden = 0.0, open = 0.0;
    Weights unseen = Weights(vec4(0.0), vec4(0.0), 0.0);
    int count = textureSize(directions, 0).y;
    vec4 walls = vec4(0.0);  // what those that are seen send in sum, and how many they are
    float margin = 0.5 * bias / body_sphere.w;
    for (int k = 0; k < count; ++k) {
        vec3 direction = texelFetch(directions, ivec2(2, k), 0).xyz;
        vec3 start = place + clear * direction;
        vec3 at = box_of(k, body_sphere, place);
        Weights basis = weights_of(k);
        vec3 light;
        if (body_by(body, k, at).a > at.z - margin) {
            open += 1.0;
            light = mix(sky_below, sky_above, 0.5 + 0.5 * dot(direction, upward));
            vec3 in_hair = box_of(k, hair_sphere, start);
            if (inside(in_hair.xy)) {
                Crossed crossed = crossed_beside(in_texture(k, in_hair), vec4(0.0));
                light *= through_hair(crossed);
                hair += filled(crossed) * basis.first;
            }
        } else {
            vec3 behind = box_of(k ^ 1, body_sphere, place);
            vec4 wall = body_by(body, k ^ 1, behind);
            if (wall.a < behind.z - margin) wall = body_by(far_body, k ^ 1, behind);
            if (wall.a < behind.z - margin) {  // between two sheets, or inside the body: no view shows what is there
                hidden += 1.0;
                unseen = Weights(unseen.first + basis.first, unseen.bend + basis.bend, unseen.last + basis.last);
                continue;
            }
            vec3 there = place + direction * max((wall.a - behind.z) * 2.0 * body_sphere.w, 0.0);
            vec3 in_hair = box_of(k ^ 1, hair_sphere, there);
            light = wall.rgb;
            if (inside(in_hair.xy)) {
                vec3 there_in_map = in_texture(k ^ 1, in_hair);
                Crossed crossed = crossed_beside(there_in_map, vec4(0.0));
                vec3 here_in_map = vec3(there_in_map.xy, box_of(k ^ 1, hair_sphere, start).z);
                crossed.counts = max(crossed.counts - crossed_beside(here_in_map, vec4(0.0)).counts, 0.0);
                light *= through_hair(crossed);
                hair += filled(crossed) * basis.first;
            }
            walls += vec4(light, 1.0);
        }
        add(light, basis);
    }
    if (open == 0.0 && 2.0 * hidden > float(count)) {  // inside the body
        red = green = blue = red_bend = green_bend = blue_bend = last_bend = hair = vec4(0.0);
        return;
    }
    // What walls that no view shows send is what the others do.
    add(walls.rgb / max(walls.a, 1.0), unseen);
}
