#version 330
// The light that comes to a place from all sides: past the body, through the hair, and from the body back.
// For red, green and blue the mean radiance, and its slope: radiance from direction d is about mean + dot(slope, d).
#include "common/deep_opacity.glsl"
uniform sampler2D receivers;   // places in the head frame [m]
uniform sampler2D directions;  // right, up and towards the sky, for every direction; 2 k and 2 k + 1 are opposite
uniform sampler2D body;        // radiance and depth, as seen from every direction
uniform int tiles;
uniform vec3 centre;           // of the sphere around hair and body [m]
uniform float radius;
uniform vec3 lost;             // of light that meets a strand, the part that does not go on
uniform vec3 sky_above;
uniform vec3 sky_below;
uniform vec3 upward;           // in the head frame
uniform float bias;            // [m]
layout(location = 0) out vec4 red;
layout(location = 1) out vec4 green;
layout(location = 2) out vec4 blue;

vec3 box_of(int k, vec3 place, out vec3 direction) {
    vec3 from = (place - centre) / radius;
    direction = texelFetch(directions, ivec2(2, k), 0).xyz;
    return 0.5 + 0.5 * vec3(dot(texelFetch(directions, ivec2(0, k), 0).xyz, from),
                            dot(texelFetch(directions, ivec2(1, k), 0).xyz, from), -dot(direction, from));
}

vec3 in_texture(int k, vec3 at) {
    return vec3((at.xy + vec2(k % tiles, k / tiles)) / float(tiles), at.z);
}

void main() {
    vec3 place = texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz;
    red = green = blue = vec4(0.0);
    float known = 0.0, margin = 0.5 * bias / radius;
    for (int k = 0; k < textureSize(directions, 0).y; ++k) {
        vec3 direction, opposite;
        vec3 at = in_texture(k, box_of(k, place, direction)), behind = in_texture(k ^ 1, box_of(k ^ 1, place, opposite));
        vec3 light;
        if (textureLod(body, at.xy, 0.0).a > at.z - margin) {
            light = mix(sky_below, sky_above, 0.5 + 0.5 * dot(direction, upward)) * exp(-lost * hair_crossed(at));
        } else {
            vec4 wall = textureLod(body, behind.xy, 0.0);
            if (wall.a < behind.z - margin) continue;  // inside the body
            float crossed = hair_crossed(vec3(behind.xy, max(wall.a, behind.z))) - hair_crossed(behind);
            light = wall.rgb * exp(-lost * crossed);
        }
        known += 1.0;
        vec4 basis = vec4(1.0, 3.0 * direction);
        red += light.r * basis;
        green += light.g * basis;
        blue += light.b * basis;
    }
    known = max(known, 1.0);
    red /= known;
    green /= known;
    blue /= known;
}
