#version 330
// A surface with one colour and a dielectric coat, as other programs' standard material has it.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/deep_opacity.glsl"
#include "common/pile.glsl"
#include "common/through_hair.glsl"
uniform vec3 diffuse;  // albedo
uniform mat4 hair_box; // of the light, around the hair alone, from the world
in vec3 v_place;
in vec3 v_normal;
in vec3 v_soft;
out vec4 colour;

const float pi = 3.14159265;
const float roughness = 0.5;  // as felt; its square is the width of the distribution
// Of the soft light outside, what comes through an opening of the body to its inside.
const float within = 0.3;
const float mirrored = 0.04;  // at normal incidence, index of refraction 1.5

float smith(float cosine) {
    float a2 = roughness * roughness * roughness * roughness;
    return 2.0 * cosine / (cosine + sqrt(a2 + (1.0 - a2) * cosine * cosine));
}

// Part of even light that the coat sends back (a fit of Karis 2013, "Physically based shading on mobile").
float coat(float n_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
    return dot(vec2(-1.04, 1.04) * a + r.zw, vec2(mirrored, 1.0));
}

void main() {
    vec3 n = normalize(v_normal), to_eye = normalize(eye.xyz - v_place), l = to_light.xyz;
    vec3 soft = v_soft;
    if (dot(n, to_eye) < 0.0) {
        n = -n;
        soft *= within;
    }
    float n_l = max(dot(n, l), 0.0), n_v = max(dot(n, to_eye), 1e-3);
    vec3 h = normalize(l + to_eye);
    float n_h = max(dot(n, h), 0.0), a2 = roughness * roughness * roughness * roughness;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float fresnel = mirrored + (1.0 - mirrored) * pow(1.0 - max(dot(h, l), 0.0), 5.0);
    float shine = a2 / (pi * d * d) * fresnel * smith(n_l) * smith(n_v) / max(4.0 * n_l * n_v, 1e-4);

    vec3 at = (hair_box * vec4(v_place + n * 0.001, 1.0)).xyz * 0.5 + 0.5;
    float lit = n_l > 0.0 ? past_objects_at(light_box(v_place + (n + l) * 0.0015), 0.001) : 0.0;
    vec3 sun = pi * radiance.rgb * n_l * lit * through_hair(crossed_beside(at, vec4(0.0)));
    float sheen = coat(n_v);
    colour = vec4(sun * (diffuse / pi * (1.0 - sheen) + shine) + soft / pi * (diffuse * (1.0 - sheen) + sheen), 1.0);
}
