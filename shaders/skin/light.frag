#version 330
// The light that living skin sends to the eye, at every pixel where it is seen. To be defined:
// LAFORTUNE for his model, or 0 for the simple one; SHOWS_VALUE where a value is shown on the skin;
// KEPT_APART where light that has entered the skin is spread in the picture; BUMPY where it may have fine wrinkles.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/highlight.glsl"
#include "common/cavity.glsl"
#include "common/lafortune.glsl"
#include "common/relief.glsl"
uniform sampler2D normals;
uniform sampler2D paint;
uniform sampler2D distances;
uniform sampler2D scattered;  // render/scattering.py
uniform sampler2D scale;      // colours of the value shown
uniform vec2 size;
uniform vec3 forward;   // where the eye looks
uniform vec3 sideward;  // from the middle of the picture to its edge, at distance 1 [m]
uniform vec3 upward;
uniform vec3 skin_colour;
uniform vec3 hair_colour;
uniform vec3 haemoglobin;     // density of a unit of blood, RGB
uniform float flushed;
uniform float blood_mean;     // painted where skin is neither flushed nor pale
uniform float blood_flow;
uniform float creases;
uniform float gloss;
uniform float roughness;
uniform float scattering;
uniform float steepest;       // curvature at the end of the table [1/m]
uniform vec3 tint;            // the skin's own colour over that of measured skin
uniform vec3 measured_diffuse;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 entered;

// Light from below the surface hardly sees fine bumps, red light least.
const vec3 softened = vec3(0.62, 0.36, 0.22);
// How far light creeps around the edge of a shadow.
const vec3 wrap = vec3(0.22, 0.09, 0.05);

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(normals, pixel, 0);
    vec4 painted = texelFetch(paint, pixel, 0);
    vec2 at = gl_FragCoord.xy / size * 2.0 - 1.0;
    vec3 from_eye = forward + at.x * sideward + at.y * upward;
    float distance_ = texelFetch(distances, pixel, 0).r;
    vec3 place = eye.xyz + from_eye * distance_;
    vec3 to_eye = -normalize(from_eye);
    vec3 smooth_n = normalize(surface.xyz);
    vec3 l = to_light.xyz;

    Relief bumps = Relief(smooth_n, 1.0, 0.0, texelFetch(states, pixel, 0).w);
    if (BUMPY == 1) bumps = relief_at(pixel, place, smooth_n);
    vec3 n = bumps.normal;

    float lips = painted.y, hair = painted.z;
    // Of the sky, of what fine bumps leave.
    float wide_open = 1.0 - painted.x, fine_open = mix(1.0, bumps.open, min(creases, 1.0)), open = wide_open * fine_open;
    // Blood, in units of haemoglobin: where skin is thin there is more to be seen of it, and pressed skin keeps more.
    float pressed = SHOWS_VALUE == 1 ? 0.0 : 1.0 - 2.0 * bumps.value;
    float blood = 0.6 * flushed * (painted.w - blood_mean) + 1.15 * 0.85 * lips + blood_flow * pressed;
    vec3 pigment = exp(-max(blood, -0.5) * haemoglobin);
    vec3 albedo = skin_colour * pigment;
    albedo = mix(albedo, hair_colour * 0.35, hair);

    float n_l = dot(n, l), smooth_n_l = dot(smooth_n, l);
    // The more the light grazes, the farther the surface itself rises into it within the soft edge of the shadow.
    float rise = min(sqrt(max(1.0 - smooth_n_l * smooth_n_l, 0.0)) / max(smooth_n_l, 0.1), 3.0);
    float lit = light_at(place + smooth_n * 0.0015, 0.0015 + 0.0035 * rise, 0.004);
    vec3 soft_lit = mix(vec3(lit), vec3(lit * (1.3 - 0.3 * lit), lit, lit), KEPT_APART == 1 ? 0.0 : min(scattering, 1.0));

    // Light that has been under the skin: of the smooth surface, bent as it is, plus what bumps add and take.
    float bend = sqrt(clamp(abs(surface.w) * scattering / steepest, 0.0, 1.0));
    vec2 table = vec2(textureSize(scattered, 0));
    vec3 around = textureLod(scattered, (vec2(0.5 + 0.5 * smooth_n_l, bend) * (table - 1.0) + 0.5) / table, 0.0).rgb;
    vec3 creep = wrap * min(scattering, 1.0);
    vec3 wrapped = clamp((vec3(smooth_n_l) + creep) / (1.0 + creep), 0.0, 1.0);
    around = KEPT_APART == 1 ? vec3(max(smooth_n_l, 0.0)) : max(around, wrapped * wrapped);
    vec3 softer = KEPT_APART == 1 ? vec3(0.0) : softened * min(scattering, 1.0);
    vec3 bumped = (max(n_l, 0.0) - max(smooth_n_l, 0.0)) * (1.0 - softer);
    // What sees next to nothing of the sky sees no lamp either, but what red walls send on.
    float seen = smoothstep(0.0, 0.05, open), root = sqrt(seen);
    vec3 reached = seen * vec3(1.0, root, root * sqrt(sqrt(root)));
    vec3 diffuse = max(around + bumped, 0.0) * soft_lit * mix(1.0, open, 0.35) * reached;
    diffuse += sent_across(wide_open, albedo, smooth_n_l) * soft_lit * fine_open;

    vec3 soft_n = normalize(mix(n, smooth_n, 0.5));
    vec3 soft = mix(ground.rgb, sky.rgb, soft_n.y * 0.5 + 0.5) * reaching(wide_open, albedo) * fine_open;

    if (SHOWS_VALUE == 1) {
        vec3 shown = textureLod(scale, vec2((bumps.value * 255.0 + 0.5) / 256.0, 0.5), 0.0).rgb;
        entered = vec4(0.0);
        colour = vec4(shown * (0.35 + 0.65 * (radiance.rgb * diffuse + soft) / (radiance.rgb + sky.rgb)), 1.0);
        return;
    }

    float n_v = max(dot(n, to_eye), 0.0), front = max(n_l, 0.0);
    vec3 mirrored, base = albedo;
    float glossy = gloss * (1.0 - hair) * mix(1.0, open, 0.92);
    if (LAFORTUNE == 0) {
        vec3 h = normalize(l + to_eye);
        float n_h = max(dot(n, h), 0.0);
        float fresnel = 0.028 + 0.972 * fifth(1.0 - max(dot(h, to_eye), 0.0));
        // Bumps too small for a pixel spread the highlight instead.
        float rough = mix(roughness, 0.72 * roughness, lips);
        float hidden_slope = bumps.hidden_slope + slope_in_pixel(surface.xyz, distance_);
        float wide = roughened(rough, hidden_slope), narrow = roughened(0.5946 * rough, hidden_slope);
        float shine = mix(lobe(n_h, front, n_v, wide), lobe(n_h, front, n_v, narrow), 0.3 + 0.2 * lips);
        mirrored = radiance.rgb * shine * fresnel * front * lit * 2.2 * glossy;
    } else {
        base = mix(measured_diffuse * tint * pigment, hair_colour * 0.35, hair);
        mirrored = radiance.rgb * 3.14159265 * lafortune_lobes(l, to_eye, n) * front * lit * glossy;
    }
    float rim = 0.024 + 0.26 * fifth(1.0 - max(dot(soft_n, to_eye), 0.0));
    vec3 sheen = mix(ground.rgb, sky.rgb, clamp(reflect(-to_eye, n).y * 0.5 + 0.5, 0.0, 1.0)) * rim * open * open;
    mirrored += sheen * min(glossy, 1.0);
    vec3 sent = base * (radiance.rgb * diffuse + soft);
    // Hair scatters nothing under itself.
    float stays = KEPT_APART == 1 ? hair : 1.0;
    colour = vec4(sent * stays + mirrored, 1.0);
    entered = vec4(sent * (1.0 - stays), 1.0 - stays);
}
