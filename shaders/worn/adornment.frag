#version 330
// Satin: light goes in and comes out all around, and its fine threads mirror some of it broadly.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/highlight.glsl"
in vec3 v_place;
in vec3 v_normal;
in vec3 v_tint;
out vec4 colour;

const float roughness = 0.7;
const float mirrored = 0.04;  // at normal incidence, index of refraction 1.5

void main() {
    vec3 n = normalize(v_normal), to_eye = normalize(eye.xyz - v_place), l = to_light.xyz;
    vec3 h = normalize(l + to_eye);
    float n_l = max(dot(n, l), 0.0), n_v = max(dot(n, to_eye), 1e-3);
    float lit = n_l > 0.0 ? light_at(v_place + n * 0.001, 0.001, 0.0015) : 0.0;
    float fresnel = mirrored + (1.0 - mirrored) * fifth(1.0 - max(dot(h, to_eye), 0.0));
    vec3 soft = mix(ground.rgb, sky.rgb, n.y * 0.5 + 0.5);
    float rim = 0.4 * mirrored + 0.06 * fifth(1.0 - n_v);
    vec3 sun = radiance.rgb * n_l * lit;
    float shine = lobe(max(dot(n, h), 0.0), n_l, n_v, roughness) * fresnel * 3.14159;
    colour = vec4(sun * (v_tint + shine) + soft * (v_tint + rim), 1.0);
}
