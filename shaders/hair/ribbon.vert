#version 330
// A ribbon along the curve of a particle's hair, turned about the hair to face the eye.
#include "common/scene.glsl"
#include "common/particles.glsl"
#include "common/strands.glsl"
in vec2 corner;               // side -1 to 1; section, root first
in int ribbon;
in float shown;               // 0 where hair in front covers it, to 1
uniform sampler2D curves;     // CURVE_DTYPE of render/ribbons.py
uniform sampler2D ribbons;    // RIBBON_DTYPE
uniform sampler2D body_distance;  // at every pixel [m]
uniform sampler2D light;      // towards the root, at the particle, towards the tip
uniform float half_width;     // of a particle's billboard [m]
uniform float ribbon_half_width;  // [m]
uniform float window_width;   // part of the strand texture that a ribbon shows
uniform vec3 hair_colour;
uniform float opacity;
uniform float transmission;
out vec2 v_at;
out vec4 v_body;    // light that comes back from all sides of a strand; side of the ribbon
out vec4 v_gleam;   // cosine of the highlight, its change with the tone of a strand, its strength; opacity

const int sections = 5;
const int texels = 2 * sections + 1;
const float least_sine = 0.3;
const float scales = 0.28;  // how far the scales tilt the darkest and the lightest strand apart
const vec3 above = vec3(0.0, 0.96, 0.28);

// A ribbon is straighter than the shoulder it lies on. Where it runs just under the skin it is drawn a little above it
// instead; what is farther behind [m] stays hidden. In between it fades: tips that point into the skin would be cut off.
const float above_skin = 0.003;
const float hidden = 0.016;

// How far the skin at the same pixel is before a place [m].
float behind_skin(vec4 at) {
    ivec2 size = textureSize(body_distance, 0);
    ivec2 pixel = ivec2((at.xy / at.w * 0.5 + 0.5) * vec2(size));
    return at.w - texelFetch(body_distance, clamp(pixel, ivec2(0), size - 1), 0).r;
}

float lifted_depth(vec4 at, float behind) {
    float lift = max(behind + above_skin, 0.0) * (1.0 - smoothstep(0.5 * hidden, hidden, behind));
    float near = shadow.z, far = shadow.w;
    return (far + near - 2.0 * far * near / (at.w - lift)) / (far - near) * at.w;
}

void main() {
    vec4 across_hair = record(ribbons, ribbon, 3, 0);
    vec4 look = record(ribbons, ribbon, 3, 1);
    float ending = record(ribbons, ribbon, 3, 2).x;
    int curve = int(look.z + 0.5);
    int section = int(corner.y);
    vec4 path = record(curves, curve, texels, section);
    vec3 middle = record(curves, curve, texels, sections + sections / 2).xyz;
    vec4 tangent = record(curves, curve, texels, sections + section);
    vec4 side = record(curves, curve, texels, 2 * sections);
    vec3 other = cross(middle, side.xyz);
    float along = path.w;

    vec2 off = across_hair.xy + across_hair.zw * along * 4.0;
    vec3 place = path.xyz + half_width * (off.x * side.xyz + off.y * other);
    vec3 t = normalize(tangent.xyz + across_hair.z * side.xyz + across_hair.w * other);

    vec3 to_eye = normalize(eye.xyz - place);
    vec3 across = cross(t, to_eye);
    float sine = length(across);
    across = sine > 1e-4 ? across / sine : side.xyz;
    // Locks run to a point where they end.
    place += across * corner.x * ribbon_half_width * length(side.xyz) * (1.0 - 0.45 * ending * max(along, 0.0) * along);

    vec3 lights = record(light, int(look.w + 0.5), 1, 0).rgb;
    float received = mix(lights.g, along < 0.0 ? lights.r : lights.b, abs(along));

    // Goldman's directionality: light that comes back against light that is sent through.
    float t_l = dot(t, to_light.xyz), t_v = dot(t, to_eye);
    float sin_l = sqrt(max(1.0 - t_l * t_l, 0.0));
    float kappa = clamp((dot(to_light.xyz, to_eye) - t_l * t_v) / max(sin_l * sine, 1e-3), -1.0, 1.0);
    float directed = 0.5 * (1.0 + kappa) + 0.5 * (1.0 - kappa) * transmission;

    // What has gone through much hair has taken its colour.
    vec3 deep = pow(vec3(max(received, 0.003)), vec3(0.85, 1.0, 1.12));
    // The soft light is Kajiya and Kay's too, as if it came from above, and a little from everywhere.
    float t_u = dot(t, above);
    float sin_u = sqrt(max(1.0 - t_u * t_u, 0.0));
    float sheen = pow(max(sin_u * sine - t_u * t_v, 0.0), 10.0);
    float open = mix(0.22, 1.0, side.w);
    vec3 soft = mix(ground.rgb, sky.rgb, 0.35 + 0.5 * sin_u) * open;
    vec3 body = hair_colour * (radiance.rgb * deep * sin_l * directed + soft * (0.68 + 1.4 * sheen)) + soft * sheen * 0.02;
    v_body = vec4(body * exp(0.20 * look.y), corner.x);
    // The cosine between the eye and the mirrored light, and how it changes where scales tilt a strand.
    float sines = max(sin_l * sine, 0.05);
    float tilt = -(t_l * sine * sine + t_v * sin_l * sin_l) / sines - t_l - t_v;
    v_gleam = vec4(sin_l * sine - t_l * t_v, scales * tilt, received * directed, min(opacity / max(sine, least_sine), 1.0) * tangent.w * shown * goes_over(along, ending));
    v_at = vec2(look.x + 0.5 * window_width * corner.x, strip_row(along, ending));
    gl_Position = clip_from_world * vec4(place, 1.0);
    float behind = behind_skin(gl_Position);
    gl_Position.z = lifted_depth(gl_Position, behind);
    v_gleam.w *= 1.0 - smoothstep(0.25 * hidden, 0.75 * hidden, behind) * (1.0 - smoothstep(hidden, 2.0 * hidden, behind));
}
