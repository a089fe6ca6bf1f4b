#version 330
// A ribbon through a particle: curved along the hair around it, turned about the hair to face the eye.
#include "common/scene.glsl"
in vec2 corner;     // side -1 to 1, along -1 (root) to 1 (tip)
in vec3 centre;
in vec3 rootward;
in vec3 direction;
in vec3 tipward;
in vec3 extent;     // half length to the root, to the tip, half width [m]
in vec4 strand;     // window, tone, particle, openness
uniform sampler2D particle_light;
uniform vec3 hair_colour;
uniform float opacity;
uniform float transmission;
out vec2 v_at;
out vec4 v_body;    // colour of the light that comes back from all sides of a strand; side of the ribbon
out vec4 v_gleam;   // cosines of the strand to the light and to the eye, strength of the highlight, opacity

const int row = 256;
const float window_width = 0.11;
const float least_sine = 0.3;

void main() {
    float a = abs(corner.y);
    vec3 end = corner.y < 0.0 ? rootward : tipward;
    float reach = corner.y < 0.0 ? -extent.x : extent.y;
    vec3 t = normalize(mix(direction, end, a));
    vec3 place = centre + reach * a * (direction + 0.5 * a * (end - direction));

    vec3 to_eye = normalize(eye.xyz - place);
    vec3 across = cross(t, to_eye);
    float sine = length(across);
    across = sine > 1e-4 ? across / sine : normalize(cross(t, vec3(0.0, 0.0, 1.0) + 0.1 * t.yzx));
    place += across * corner.x * extent.z;

    int particle = int(strand.z + 0.5);
    vec2 light = texelFetch(particle_light, ivec2(particle % row, particle / row), 0).rg;

    // Goldman's directionality: light that comes back against light that is sent through.
    float t_l = dot(t, to_light.xyz), t_v = dot(t, to_eye);
    float sin_l = sqrt(max(1.0 - t_l * t_l, 0.0)), sin_v = max(sine, 1e-3);
    float kappa = clamp((dot(to_light.xyz, to_eye) - t_l * t_v) / max(sin_l * sin_v, 1e-3), -1.0, 1.0);
    float directed = 0.5 * (1.0 + kappa) + 0.5 * (1.0 - kappa) * transmission;

    // What has gone through much hair has taken its colour.
    vec3 deep = pow(vec3(max(light.r, 0.004)), vec3(0.85, 1.0, 1.12));
    vec3 soft = mix(ground.rgb, sky.rgb, 0.5 + 0.35 * to_eye.y + 0.3 * (1.0 - abs(t.y)));
    float tone = exp(0.16 * strand.y);
    vec3 body = hair_colour * tone * (radiance.rgb * deep * sin_l * directed * 1.6 + soft * mix(0.25, 1.0, strand.w));
    v_body = vec4(body, corner.x);
    v_gleam = vec4(t_l, t_v, light.r * directed, min(opacity / max(sine, least_sine), 1.0));
    v_at = vec2(strand.x + 0.5 * window_width * corner.x, 0.5 + 0.5 * (corner.y < 0.0 ? -a * extent.x / extent.y : a));
    gl_Position = clip_from_world * vec4(place, 1.0);
}
