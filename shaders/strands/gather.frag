#version 330
// The light that comes to a place from all sides: past the body, through the hair, and from the body back.
// For red, green and blue the mean radiance, and its slope: radiance from direction d is about mean + dot(slope, d).
#include "common/deep_opacity.glsl"
uniform sampler2D receivers;   // places in the head frame [m]
uniform sampler2D directions;  // right, up and towards the sky, for every direction; 2 k and 2 k + 1 are opposite
uniform sampler2D body;        // radiance and depth, as seen from every direction
uniform int tiles;
uniform vec4 body_sphere;      // centre and radius [m] of what the views of the body show
uniform vec4 hair_sphere;      // and of those of the hair
uniform vec3 lost;             // of light that meets a strand, the part that does not go on
uniform vec3 sky_above;
uniform vec3 sky_below;
uniform vec3 upward;           // in the head frame
uniform vec3 body_mean;        // radiance of the body in the mean
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

bool beside(vec2 at) {
    return any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(1.0)));
}

float hair_crossed_by(int k, vec3 place) {
    vec3 at = box_of(k, hair_sphere, place);
    return beside(at.xy) ? 0.0 : hair_crossed(in_texture(k, at));
}

// Radiance of the body and its depth, as seen in view k along the line through a place; far away where there is none.
vec4 body_by(int k, vec3 at) {
    return beside(at.xy) ? vec4(0.0, 0.0, 0.0, 1e9) : textureLod(body, in_texture(k, at).xy, 0.0);
}

void main() {
    vec3 place = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz;
    red = green = blue = vec4(0.0);
    float known = 0.0, open = 0.0, hidden = 0.0;
    vec4 hidden_basis = vec4(0.0);
    float margin = 0.5 * bias / body_sphere.w;
    for (int k = 0; k < textureSize(directions, 0).y; ++k) {
        vec3 direction = texelFetch(directions, ivec2(2, k), 0).xyz;
        vec3 start = place + clear * direction;
        vec3 at = box_of(k, body_sphere, place);
        vec4 basis = vec4(1.0, 3.0 * direction);
        vec3 light;
        if (body_by(k, at).a > at.z - margin) {
            open += 1.0;
            light = mix(sky_below, sky_above, 0.5 + 0.5 * dot(direction, upward)) * exp(-lost * hair_crossed_by(k, start));
        } else {
            vec3 behind = box_of(k ^ 1, body_sphere, place);
            vec4 wall = body_by(k ^ 1, behind);
            if (wall.a < behind.z - margin) {  // in a hollow, or inside the body: no view shows what is there
                hidden += 1.0;
                hidden_basis += basis;
                continue;
            }
            vec3 there = place + direction * max((wall.a - behind.z) * 2.0 * body_sphere.w, 0.0);
            float crossed = max(hair_crossed_by(k ^ 1, there) - hair_crossed_by(k ^ 1, start), 0.0);
            light = wall.rgb * exp(-lost * crossed);
        }
        known += 1.0;
        red += light.r * basis;
        green += light.g * basis;
        blue += light.b * basis;
    }
    if (open > 0.0) {
        // A place that sees some sky is in a hollow, whose walls send about as much light as the body does elsewhere.
        red += body_mean.r * hidden_basis;
        green += body_mean.g * hidden_basis;
        blue += body_mean.b * hidden_basis;
        known += hidden;
    }
    known = max(known, 1.0);
    red /= known;
    green /= known;
    blue /= known;
}
