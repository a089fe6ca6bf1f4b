#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/shadow.glsl"
uniform int kind;          // 0 eye, 1 teeth, 2 tongue, 3 lashes and brows, 4 other
uniform vec4 ball;         // centre and radius of an eye, head frame [m]
uniform vec3 pupil;        // where the eye looks, head frame
uniform vec3 iris_colour;
uniform vec3 skin_colour;
uniform vec3 hair_colour;
in vec3 v_place;
in vec3 v_rest;
in vec3 v_normal;
out vec4 colour;

const float iris_radius = 0.0059;
const float pupil_radius = 0.0019;

float noise(float x) {
    float i = floor(x), f = fract(x);
    float a = fract(sin(i * 127.1) * 43758.5453), b = fract(sin((i + 1.0) * 127.1) * 43758.5453);
    return mix(a, b, f * f * (3.0 - 2.0 * f));
}

// Colour of the eye at a direction from its centre: sclera, limbal ring, iris with its fibres, pupil.
vec3 eye_colour(vec3 d) {
    float r = length(d - pupil * dot(d, pupil)) * ball.w;
    if (dot(d, pupil) < 0.0) r = ball.w;
    vec3 side = normalize(cross(vec3(0.0, 1.0, 0.0), pupil));
    float angle = atan(dot(d, cross(pupil, side)), dot(d, side));
    vec3 sclera = vec3(0.80, 0.75, 0.71) - vec3(0.05, 0.20, 0.20) * smoothstep(0.007, 0.013, r);
    float fibres = 0.55 * noise(angle * 14.0) + 0.45 * noise(angle * 31.0 + 7.0);
    float inward = clamp((r - pupil_radius) / (iris_radius - pupil_radius), 0.0, 1.0);
    vec3 iris = iris_colour * mix(0.75, 1.55, fibres) * mix(1.25, 0.8, inward);
    iris = mix(iris, iris_colour * vec3(1.5, 1.15, 0.7), 0.45 * (1.0 - smoothstep(0.0, 0.45, inward)));
    iris *= 1.0 - 0.78 * smoothstep(0.72, 1.0, inward);
    vec3 shown = mix(iris, sclera, smoothstep(iris_radius - 0.0003, iris_radius + 0.0006, r));
    return mix(vec3(0.006), shown, smoothstep(pupil_radius - 0.0002, pupil_radius + 0.0003, r));
}

void main() {
    vec3 n = normalize(v_normal);
    vec3 to_eye = normalize(eye.xyz - v_place);
    vec3 l = to_light.xyz;
    if (dot(n, to_eye) < 0.0) n = -n;
    float lit = shadow.x > 0.5 ? past_objects(v_place, 0.003, 0.003) * through_hair(v_place, 0.003) : 1.0;

    vec3 albedo;
    float gloss, shine_strength, open = 1.0;
    if (kind == 0) {
        vec3 d = normalize(v_rest - ball.xyz);
        albedo = eye_colour(d);
        n = normalize(turned(d, head_turn.xyz));
        gloss = 900.0;
        shine_strength = 9.0;
        // The lids shade the ball: more from above, and in the corners.
        open = (1.0 - 0.62 * smoothstep(0.12, 0.50, d.y)) * (1.0 - 0.35 * smoothstep(0.45, 0.8, abs(d.x - pupil.x)));
    } else if (kind == 1) {
        albedo = vec3(0.78, 0.72, 0.62);
        gloss = 120.0;
        shine_strength = 0.6;
        open = 0.35;
    } else if (kind == 2) {
        albedo = skin_colour * vec3(0.85, 0.35, 0.35);
        gloss = 60.0;
        shine_strength = 0.3;
        open = 0.35;
    } else if (kind == 3) {
        albedo = hair_colour * 0.10 + 0.004;
        gloss = 20.0;
        shine_strength = 0.02;
    } else {
        albedo = vec3(0.5);
        gloss = 30.0;
        shine_strength = 0.05;
    }
    float n_l = clamp((dot(n, l) + 0.15) / 1.15, 0.0, 1.0);
    vec3 soft = mix(ground.rgb, sky.rgb, n.y * 0.5 + 0.5) * open;
    float shine = pow(max(dot(n, normalize(l + to_eye)), 0.0), gloss) * shine_strength * lit;
    vec3 mirrored = reflect(-to_eye, n);
    float wet = kind == 0 ? 0.03 + 0.35 * pow(1.0 - max(dot(n, to_eye), 0.0), 5.0) : 0.0;
    vec3 window = sky.rgb * smoothstep(0.35, 0.75, mirrored.y) * 2.0 * wet * open;
    colour = vec4(albedo * (radiance.rgb * n_l * lit * mix(1.0, open, 0.6) + soft) + radiance.rgb * shine + window, 1.0);
}
