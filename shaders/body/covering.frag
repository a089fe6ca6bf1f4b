#version 330
// The light of the skin, worked out once a pixel, for every sample of it that the skin covers.
uniform sampler2D lit;        // the picture of the skin alone
uniform sampler2D distances;  // from the eye to what it shows [m]
in float v_distance;
out vec4 colour;

// Steps of distance [m] from pixel to pixel that are still the same skin.
const float same_skin = 0.002;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(lit, 0) - 1;
    float nearest = abs(texelFetch(distances, here, 0).r - v_distance);
    ivec2 found = here;
    // At an edge the middle of the pixel shows something else: then the neighbour that shows this skin.
    if (nearest > same_skin)
        for (int k = 0; k < 9; ++k) {
            ivec2 there = clamp(here + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), last);
            float apart = abs(texelFetch(distances, there, 0).r - v_distance);
            if (apart < nearest) {
                nearest = apart;
                found = there;
            }
        }
    colour = vec4(texelFetch(lit, found, 0).rgb, 1.0);
}
