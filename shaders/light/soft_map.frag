#version 330
// The light map with soft edges: the mean of 3 x 3 texels of its coarsest level, weighted 1, 2 and 1.
uniform sampler2D light_map;
uniform float size;  // texels of the map drawn into
out float light;

const float coarsest = 16.0;

void main() {
    vec2 half_texel = 0.5 / vec2(size, -size), at = gl_FragCoord.xy / size;
    light = 0.25 * (textureLod(light_map, at - half_texel.xx, coarsest).r + textureLod(light_map, at + half_texel.xx, coarsest).r
                    + textureLod(light_map, at - half_texel, coarsest).r + textureLod(light_map, at + half_texel, coarsest).r);
}
