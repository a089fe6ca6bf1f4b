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

const float softness = 0.003;  // [m]

void main() {
    vec2 strand = texture(strands, v_at).rg;
    // Behind the body nothing, and within a few millimetres of it less and less.
    float behind = texelFetch(body_depth, ivec2(gl_FragCoord.xy), 0).r - gl_FragCoord.z;
    float depth = 1.0 / gl_FragCoord.w;
    float clear = behind * depth * depth * (1.0 / shadow.z - 1.0 / shadow.w);
    float alpha = strand.r * sides(v_body.w) * v_gleam.w * clamp(clear / softness + 0.5, 0.0, 1.0);

    // Kajiya and Kay's highlight, moved along each strand by its own scales; a second, wider one has the hair's colour.
    float shift = 0.28 * (strand.g - 0.5);
    float t_l = v_gleam.x + shift, t_v = v_gleam.y + shift;
    float cosine = max(sqrt(max((1.0 - t_l * t_l) * (1.0 - t_v * t_v), 0.0)) - t_l * t_v, 0.0);
    float wide = pow(cosine, gloss * 0.25);
    float narrow = wide * wide * wide * wide;
    vec3 gleam = radiance.rgb * v_gleam.z * (0.12 * narrow + 0.9 * wide * hair_colour);

    colour = vec4((v_body.rgb + gleam) * (0.25 + 1.5 * strand.g) * alpha, alpha);
}
