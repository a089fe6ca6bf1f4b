#version 330
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/shadow.glsl"
#include "common/cavity.glsl"
uniform int kind;          // 0 eye, 1 teeth, 2 tongue, 3 lashes and brows, 4 other
uniform vec4 ball;         // centre and radius of an eye, head frame [m]
uniform vec3 pupil;        // where the eye looks, head frame
uniform vec3 iris_colour;
uniform vec3 skin_colour;
uniform vec3 hair_colour;
in vec3 v_place;
in vec3 v_rest;
in vec3 v_normal;
in vec3 v_paint;
out vec4 colour;

// Of the ball's radius.
const float iris_radius = 0.45;
const float pupil_radius = 0.15;
const float teeth_in_row = 14.0;
// Of the inside of a mouth, over that of skin.
const vec3 flesh = vec3(0.85, 0.36, 0.36);

float noise(float x) {
    float i = floor(x), f = fract(x);
    float a = fract(sin(i * 127.1) * 43758.5453), b = fract(sin((i + 1.0) * 127.1) * 43758.5453);
    return mix(a, b, f * f * (3.0 - 2.0 * f));
}

// Colour of the eye at a direction from its centre: sclera, limbal ring, iris with its fibres, pupil.
vec3 eye_colour(vec3 d) {
    float r = dot(d, pupil) > 0.0 ? length(d - pupil * dot(d, pupil)) : 1.0;
    vec3 side = normalize(cross(vec3(0.0, 1.0, 0.0), pupil));
    float angle = atan(dot(d, cross(pupil, side)), dot(d, side));
    vec3 sclera = vec3(0.74, 0.69, 0.65) - vec3(0.06, 0.20, 0.20) * smoothstep(0.55, 0.9, r);
    float fibres = 0.55 * noise(angle * 14.0) + 0.45 * noise(angle * 31.0 + 7.0);
    float inward = clamp((r - pupil_radius) / (iris_radius - pupil_radius), 0.0, 1.0);
    vec3 iris = iris_colour * mix(0.45, 1.15, fibres) * mix(1.2, 0.8, inward);
    iris = mix(iris, iris_colour * vec3(1.3, 1.0, 0.6), 0.4 * (1.0 - smoothstep(0.0, 0.45, inward)));
    iris *= 1.0 - 0.75 * smoothstep(0.70, 1.0, inward);
    vec3 shown = mix(iris, sclera, smoothstep(iris_radius - 0.03, iris_radius + 0.05, r));
    return mix(vec3(0.006), shown, smoothstep(pupil_radius - 0.02, pupil_radius + 0.03, r));
}

void main() {
    vec3 n = normalize(v_normal);
    vec3 to_eye = normalize(eye.xyz - v_place);
    vec3 l = to_light.xyz;
    if (dot(n, to_eye) < 0.0) n = -n;
    float lit = light_at(v_place, 0.003, 0.003);
    float open = 1.0 - v_paint.x;

    vec3 albedo;
    float gloss, strength, alpha = 1.0;
    if (kind == 0) {
        vec3 d = normalize(v_rest - ball.xyz);
        albedo = eye_colour(d);
        n = normalize(turned(d, head_turn.xyz));
        gloss = 900.0;
        strength = 9.0;
    } else if (kind == 1) {
        // Single teeth: narrow ones in front, molars behind, a dark line between two and round sides.
        float tooth = teeth_in_row * (0.5 + 0.5 * sin(1.35 * (v_paint.y - 0.5)) / sin(0.675));
        float beside = abs(fract(tooth) - 0.5) * 2.0;
        albedo = vec3(0.70, 0.64, 0.54) * (1.0 - 0.5 * smoothstep(0.86, 1.0, beside));
        albedo = mix(albedo, skin_colour * flesh, v_paint.z);
        gloss = 120.0;
        strength = 0.5 * (1.0 - beside * beside);
    } else if (kind == 2) {
        albedo = skin_colour * flesh;
        gloss = 60.0;
        strength = 0.3;
    } else if (kind == 3) {
        // Single hairs, a third of a millimetre apart, that thin out towards their tips.
        float hairs = noise(v_rest.x * 3500.0 + v_rest.y * 900.0);
        albedo = hair_colour * 0.08 + 0.003;
        alpha = clamp(1.4 - 1.4 * v_paint.y, 0.0, 1.0) * mix(1.0, 1.4 * hairs, smoothstep(0.1, 0.6, v_paint.y));
        gloss = 20.0;
        strength = 0.02;
    } else {
        albedo = vec3(0.5);
        gloss = 30.0;
        strength = 0.05;
    }
    float n_l = clamp((dot(n, l) + 0.15) / 1.15, 0.0, 1.0);
    // The deeper in the mouth, the more of its light has been on red walls.
    bool in_mouth = kind == 1 || kind == 2;
    vec3 reached = in_mouth ? reaching(open, skin_colour * flesh) : vec3(open);
    vec3 soft = mix(ground.rgb, sky.rgb, n.y * 0.5 + 0.5) * reached;
    float shine = pow(max(dot(n, normalize(l + to_eye)), 0.0), gloss) * strength * lit * (in_mouth ? open : 1.0);
    // A wet eye mirrors the bright sky, more towards its rim.
    float wet = kind == 0 ? 0.03 + 0.35 * pow(1.0 - max(dot(n, to_eye), 0.0), 5.0) : 0.0;
    vec3 mirrored = sky.rgb * smoothstep(0.35, 0.75, reflect(-to_eye, n).y) * 2.0 * wet * open;
    vec3 shown = albedo * (radiance.rgb * n_l * lit * (in_mouth ? reached : vec3(mix(0.35, 1.0, open))) + soft) + radiance.rgb * shine + mirrored;
    colour = vec4(shown * alpha, alpha);
}
