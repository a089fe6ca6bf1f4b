#version 330
// The light that the skin sends to the eye, at every pixel where it is seen.
#include "common/scene.glsl"
#include "common/shadow.glsl"
#include "common/highlight.glsl"
#include "common/cavity.glsl"
uniform sampler2D normals;
uniform sampler2D paint;
uniform sampler2D distances;
uniform vec2 size;
uniform vec3 forward;   // where the eye looks
uniform vec3 sideward;  // from the middle of the picture to its edge, at distance 1 [m]
uniform vec3 upward;
uniform vec3 skin_colour;
uniform vec3 hair_colour;
out vec4 colour;

// Light creeps around the edge of the shadow, red the farthest, since red travels farthest under the skin.
const vec3 wrap = vec3(0.34, 0.15, 0.09);

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(normals, pixel, 0);
    vec4 painted = texelFetch(paint, pixel, 0);
    vec2 at = gl_FragCoord.xy / size * 2.0 - 1.0;
    vec3 from_eye = forward + at.x * sideward + at.y * upward;
    float distance_ = texelFetch(distances, pixel, 0).r;
    vec3 place = eye.xyz + from_eye * distance_;
    vec3 to_eye = -normalize(from_eye);
    vec3 n = normalize(surface.xyz);
    vec3 l = to_light.xyz;

    float lips = painted.y, brow = painted.z, flush = painted.w, cover = surface.w;
    vec3 albedo = skin_colour;
    albedo *= mix(vec3(1.0), vec3(1.06, 0.80, 0.78), flush);
    albedo = mix(albedo, skin_colour * vec3(0.86, 0.44, 0.46), lips * 0.85);
    // Where long hair grows the ground is dark between it.
    albedo = mix(albedo, hair_colour * 0.35, max(brow, cover));

    float lit = light_at(place + n * 0.0015, 0.0015 + 0.003 * (1.0 - max(dot(n, l), 0.0)), 0.004);
    vec3 soft_lit = vec3(lit * (1.3 - 0.3 * lit), lit, lit);

    float n_l = dot(n, l);
    vec3 wrapped = clamp((vec3(n_l) + wrap) / (1.0 + wrap), 0.0, 1.0);
    float open = 1.0 - painted.x;
    vec3 diffuse = (mix(wrapped * wrapped, vec3(max(n_l, 0.0)), 0.35) + sent_across(open, albedo, n_l)) * soft_lit;

    vec3 soft = mix(ground.rgb, sky.rgb, n.y * 0.5 + 0.5) * reaching(open, albedo);

    vec3 h = normalize(l + to_eye);
    float n_h = max(dot(n, h), 0.0), n_v = max(dot(n, to_eye), 0.0), front = max(n_l, 0.0);
    float fresnel = 0.028 + 0.972 * fifth(1.0 - max(dot(h, to_eye), 0.0));
    float rough = mix(0.48, 0.34, lips);
    float hidden_slope = slope_in_pixel(surface.xyz, distance_);
    float wide = roughened(rough, hidden_slope), narrow = roughened(0.58 * rough, hidden_slope);
    float shine = mix(lobe(n_h, front, n_v, wide), lobe(n_h, front, n_v, narrow), 0.28 + 0.2 * lips);
    // The map of the shadows is too coarse for a crease: what hides most of the sky there hides the lamp, too.
    shine *= fresnel * front * lit * 2.2 * (1.0 - max(brow, cover)) * mix(1.0, open, 0.92);
    float rim = 0.028 + 0.30 * fifth(1.0 - n_v);
    vec3 sheen = mix(ground.rgb, sky.rgb, clamp(reflect(-to_eye, n).y * 0.5 + 0.5, 0.0, 1.0)) * rim * open * open;

    vec3 mirrored = radiance.rgb * shine + sheen * (1.0 - cover);
    colour = vec4(albedo * (radiance.rgb * diffuse + soft) + mirrored, 1.0);
}
