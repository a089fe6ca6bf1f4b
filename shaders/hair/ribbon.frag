#version 330
#include "common/scene.glsl"
#include "common/strands.glsl"
uniform sampler2D body_depth;
uniform vec3 hair_colour;
uniform float gloss;
in vec2 v_at;
in vec4 v_body;
in vec4 v_gleam;
out vec4 colour;

void main() {
    vec2 strand = texture(strands, v_at).rg;
    float alpha = strand.r * sides(v_body.w) * v_gleam.w;

    // Kajiya and Kay's highlight, moved along each strand by its own scales; a second, wider one has the hair's colour.
    float shift = 0.30 * (strand.g - 0.5);
    float t_l = v_gleam.x + shift, t_v = v_gleam.y + shift;
    float cosine = max(sqrt(max(1.0 - t_l * t_l, 0.0)) * sqrt(max(1.0 - t_v * t_v, 0.0)) - t_l * t_v, 0.0);
    float wide = pow(cosine, gloss * 0.25);
    float narrow = wide * wide * wide * wide;
    vec3 gleam = radiance.rgb * v_gleam.z * (0.10 * narrow + 0.9 * wide * hair_colour);

    vec3 shade = v_body.rgb * (0.35 + 1.3 * strand.g) + gleam * (0.4 + 1.2 * strand.g);
    colour = vec4(shade * alpha, alpha);
}
