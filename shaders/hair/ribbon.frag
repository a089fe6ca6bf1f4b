#version 330
#include "common/scene.glsl"
#include "common/strands.glsl"
uniform vec3 hair_colour;
uniform float gloss;
in vec2 v_at;
in vec4 v_body;
in vec4 v_gleam;
out vec4 colour;

void main() {
    vec2 strand = textureLod(strands, v_at, 0.0).rg;
    float alpha = strand.r * sides(v_body.w) * v_gleam.w;

    // Kajiya and Kay's highlight, moved along each strand by its own scales; a second, wider one has the hair's colour.
    float cosine = clamp(v_gleam.x + v_gleam.y * (strand.g - 0.5), 0.0, 1.0);
    // Schlick's rational stand-in for the power gloss / 8, squared.
    float wide = cosine / (0.125 * gloss * (1.0 - cosine) + cosine);
    wide *= wide;
    float narrow = wide * wide * wide * wide;
    vec3 gleam = radiance.rgb * v_gleam.z * (0.07 * narrow + 0.9 * wide * hair_colour);

    colour = vec4((v_body.rgb + gleam) * (0.25 + 1.5 * strand.g) * alpha, alpha);
}
