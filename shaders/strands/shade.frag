#version 330
// The radiance of every point of every strand towards the eye; one texel is one point.
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/shadow.glsl"
#include "common/strand_points.glsl"
#include "common/deep_opacity.glsl"
#include "common/fibre.glsl"
#include "common/soft_light.glsl"
#include "common/pile.glsl"
uniform sampler2D hair_colours;
uniform bool coloured;         // every point has a colour of its own
uniform vec3 hair_absorption;  // else: per radius
uniform float colour_slope;
uniform float followed;        // how far light is followed from strand to strand (render/fibre.py: followed)
uniform bool fibre_model;      // Marschner's lobes, or Kajiya and Kay's
uniform float light_widening;  // how many times too thick strands are in the light's map
uniform int light_points;      // so many points are of strands that are in it
uniform mat4 hair_box;         // of the light, around the hair alone, from the world
uniform float box_size;        // [m]
out vec4 radiance_;

// Strands within this distance [m] send light back.
const float behind_depth = 0.05;
const float pi = 3.14159265;

vec3 absorption_at(ivec2 texel) {
    if (!coloured) return hair_absorption;
    vec3 root = log(clamp(texelFetch(hair_colours, texel, 0).rgb, 1e-3, 0.98)) / colour_slope;
    return root * root;
}

float azimuth_between(vec3 along, vec3 a, vec3 b) {
    vec3 u = a - along * dot(a, along), v = b - along * dot(b, along);
    return acos(clamp(dot(u, v) / max(length(u) * length(v), 1e-6), -1.0, 1.0));
}

// Kajiya, Kay 1989: a cylinder that scatters evenly, and mirrors along a cone; scaled to send as much as a fibre does.
vec3 kajiya_kay(float sin_in, float sin_out, vec3 colour, float mirrored) {
    float cos_in = sqrt(max(1.0 - sin_in * sin_in, 0.0)), cos_out = sqrt(max(1.0 - sin_out * sin_out, 0.0));
    float cone = pow(max(cos_in * cos_out - sin_in * sin_out, 0.0), 1.0 / variances.x);
    return colour * cos_in / (pi * pi) + mirrored * cone * inversesqrt(2.0 * pi * variances.x) / (2.0 * pi);
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec4 point = texelFetch(points, texel, 0);
    vec3 place = turned(point.xyz, head_turn.xyz) + head_shift.xyz;
    vec3 along = normalize(turned(texelFetch(tangents, texel, 0).xyz, head_turn.xyz));
    vec3 to_eye = normalize(eye.xyz - place);
    vec3 absorption = absorption_at(texel);
    float sin_in = dot(to_light.xyz, along), sin_out = dot(to_eye, along);
    float phi = azimuth_between(along, to_light.xyz, to_eye);

    vec3 at = (hair_box * vec4(place, 1.0)).xyz * 0.5 + 0.5;
    float texels = 2.0 * point.w * light_widening * float(textureSize(near_counts, 0).x) / box_size;
    vec4 own = vec4(0.0);
    if (texel.x + texel.y * point_row < light_points) own = own_counts(at.xy, (hair_box * vec4(along, 0.0)).xy, 0.5 * texels);
    // No other strand is so near that its half chord and this one's, pi / 4 radii each in the mean, would meet: strands do not
    // stand in one another. What is nearer is this strand itself.
    float cos_in = sqrt(max(1.0 - sin_in * sin_in, 1e-6));
    float near = 0.5 * pi * point.w / (box_size * cos_in);
    Crossed way = crossed_beside(at - vec3(0.0, 0.0, near), own);
    float count = dot(way.counts, way.shares);
    float behind = max(hair_crossed(vec3(at.xy, at.z + behind_depth / box_size)) - dot(own, way.shares) - count, 0.0);
    if (shadow.x < 0.5) way.counts = vec4(0.0);
    float crossed = dot(way.counts, way.shares);
    float lit = shadow.x < 0.5 ? 1.0 : past_objects_at(light_box(place + to_light.xyz * 0.002), 0.002);

    Sent sent_in = sent_on(sin_in, absorption), sent = sent_on(sin_out, absorption);
    // What comes past the strands, what else there is once light has gone on, and what of all strands behind send back. A
    // strand is there or not, and so each texel beside the place has its own answer.
    float direct = 0.0;
    vec3 scattered = vec3(0.0), returned = vec3(0.0);
    Pile piles[2];
    float kept = followed;
    for (int k = 0; k < 2; ++k, kept *= followed) {
        piles[k] = pile(kept * on(sent_in), kept * back(sent_in));
        piles[k].rate = taken(piles[k].rate);
    }
    vec3 closed_first = closed_by(piles[0], behind), closed_second = closed_by(piles[1], behind);
    vec3 back_first = 2.0 * sent_back_by(piles[0], behind), back_second = sent_back_by(piles[1], behind);
    for (int k = 0; k < 4; ++k) {
        float past = exp(-opaque * way.counts[k]);
        vec3 first = going_on(piles[0], way.counts[k], closed_first),
             second = going_on(piles[1], way.counts[k], closed_second);
        direct += way.shares[k] * past;
        scattered += way.shares[k] * max(2.0 * first - second - past, 0.0);
        returned += way.shares[k] * (first * back_first - second * back_second);
    }

    // Of the soft light what a strand turns to the eye comes from the cone that mirrors it. There, by the azimuth from the
    // eye, it is level + aside cos(phi) + twice cos(2 phi).
    SoftLight soft = soft_light(point.xyz);
    float sin_2 = sin_out * sin_out, cos_2 = 1.0 - sin_2;
    vec3 hair = turned(along, -head_turn.xyz), eyeward = turned(to_eye - along * sin_out, -head_turn.xyz);
    vec3 along_hair_bent = bend_along(soft, hair, hair);
    vec3 level = soft.mean - sin_out * (soft.slope * hair) + (sin_2 - 0.5 * cos_2) * along_hair_bent;
    vec3 aside = soft.slope * eyeward - 2.0 * sin_out * bend_along(soft, hair, eyeward);
    vec3 twice = bend_along(soft, eyeward, eyeward) + 0.5 * cos_2 * along_hair_bent;

    // Of what strands behind a strand send back, it sends on what it sends forward.
    vec3 from_light, from_sky;
    if (fibre_model) {
        vec4 wider = vec4(min(crossed, 8.0) * variances.y);
        from_light = direct * around_hair(around_table, phi, sin_out, absorption, along_hair(sin_in, sin_out, vec4(0.0)))
            + scattered * around_hair(spread_table, phi, sin_out, absorption, along_hair(sin_in, sin_out, wider))
            + returned * on(sent_in) * along_hair(sin_in, sin_out, vec4(0.0)).z * 0.5 * max(cos(phi), 0.0);
        // Three numbers swing below nothing where light ends at an edge, and there is no light less than none.
        vec3 from_behind = vec3(0.0), from_before = vec3(0.0);
        for (int k = 0; k < 4; ++k) {
            vec3 even = level + part_cos_twice[k] * twice, odd = part_cos[k] * aside;
            from_before += sent.back[k] * max(even + odd, 0.0);
            from_behind += sent.forward[k] * max(even - odd, 0.0);
        }
        // Hair on either side sends back what comes from the other, again and again (Kubelka 1948).
        vec3 eyeward_half = max(level + 0.25 * pi * aside + twice / 3.0, 0.0);
        vec3 other_half = max(level - 0.25 * pi * aside + twice / 3.0, 0.0);
        vec3 head_to_eye = turned(to_eye, -head_turn.xyz);
        float before = strands_towards(soft, head_to_eye), after = strands_towards(soft, -head_to_eye);
        vec3 more_behind = vec3(0.0), more_before = vec3(0.0);
        kept = followed;
        for (int k = 0; k < 2; ++k, kept *= followed) {
            Pile less = pile(kept * on(sent), kept * back(sent));
            vec3 back_before = sent_back_by(less, before), back_behind = sent_back_by(less, after);
            vec3 again = (k == 0 ? 2.0 : -1.0) / (1.0 - back_before * back_behind);
            more_behind += back_behind * again * (eyeward_half + back_before * other_half);
            more_before += back_before * again * (other_half + back_behind * eyeward_half);
        }
        from_sky = from_behind + from_before + on(sent) * more_behind + back(sent) * more_before;
    } else {
        vec3 colour = exp(-sqrt(absorption) * colour_slope);
        from_light = direct * kajiya_kay(sin_in, sin_out, colour, 0.05) + scattered * kajiya_kay(sin_in, sin_out, colour, 0.0);
        from_sky = colour * max(level + 0.25 * pi * aside + twice / 3.0, 0.0);
    }
    radiance_ = vec4(pi * radiance.rgb * lit * from_light + from_sky, 1.0);
}
