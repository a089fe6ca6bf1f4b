#version 330
// The light that comes to a place from all sides: past the body, through the hair, and from the body back.
// For red, green and blue the mean radiance, and its slope: radiance from direction d is about mean + dot(slope, d).
#include "common/deep_opacity.glsl"
uniform sampler2D receivers;   // places in the head frame [m]
uniform sampler2D directions;  // right, up and towards the sky, for every direction; 2 k and 2 k + 1 are opposite
uniform sampler2D body;        // radiance and depth, as seen from every direction
uniform sampler2D far_body;    // and of the last that faces there: what lies under an overhang
uniform int tiles;
uniform vec4 body_sphere;      // centre and radius [m] of what the views of the body show
uniform vec4 hair_sphere;      // and of those of the hair
uniform vec3 taken;            // by hair: by what the logarithm of the light falls with the count of strands
uniform vec3 sky_above;
uniform vec3 sky_below;
uniform vec3 upward;           // in the head frame
uniform float bias;            // [m]
uniform float clear;           // so near to a place there is no strand [m]
layout(location = 0) out vec4 red;
layout(location = 1) out vec4 green;
layout(location = 2) out vec4 blue;

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

// Radiance of the body and its depth, as seen in view k along the line through a place; far away where there is none.
vec4 body_by(sampler2D seen, int k, vec3 at) {
    return inside(at.xy) ? textureLod(seen, in_texture(k, at).xy, 0.0) : vec4(0.0, 0.0, 0.0, 1e9);
}

void main() {
    vec3 place = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz;
    red = green = blue = vec4(0.0);
    float known = 0.0, open = 0.0;
    vec4 hidden = vec4(0.0);
    vec4 walls = vec4(0.0);  // what those that are seen send in sum, and how many they are
    float margin = 0.5 * bias / body_sphere.w;
    for (int k = 0; k < textureSize(directions, 0).y; ++k) {
        vec3 direction = texelFetch(directions, ivec2(2, k), 0).xyz;
        vec3 start = place + clear * direction;
        vec3 at = box_of(k, body_sphere, place);
        vec4 basis = vec4(1.0, 3.0 * direction);
        vec3 light;
        if (body_by(body, k, at).a > at.z - margin) {
            open += 1.0;
            light = mix(sky_below, sky_above, 0.5 + 0.5 * dot(direction, upward));
            vec3 in_hair = box_of(k, hair_sphere, start);
            if (inside(in_hair.xy)) light *= through_hair(in_texture(k, in_hair), 0.0, taken);
        } else {
            vec3 behind = box_of(k ^ 1, body_sphere, place);
            vec4 wall = body_by(body, k ^ 1, behind);
            if (wall.a < behind.z - margin) wall = body_by(far_body, k ^ 1, behind);
            if (wall.a < behind.z - margin) {  // between two sheets, or inside the body: no view shows what is there
                hidden += basis;
                continue;
            }
            vec3 there = place + direction * max((wall.a - behind.z) * 2.0 * body_sphere.w, 0.0);
            vec3 in_hair = box_of(k ^ 1, hair_sphere, there);
            light = wall.rgb;
            if (inside(in_hair.xy)) light *= through_hair(in_texture(k ^ 1, in_hair), box_of(k ^ 1, hair_sphere, start).z, taken);
            walls += vec4(light, 1.0);
        }
        known += 1.0;
        red += light.r * basis;
        green += light.g * basis;
        blue += light.b * basis;
    }
    if (open == 0.0 && known < hidden.x) {  // inside the body
        red = green = blue = vec4(0.0);
        return;
    }
    // What walls that no view shows send is what the others do.
    vec3 wall = walls.rgb / max(walls.a, 1.0);
    known += hidden.x;
    red = (red + wall.r * hidden) / known;
    green = (green + wall.g * hidden) / known;
    blue = (blue + wall.b * hidden) / known;
}
