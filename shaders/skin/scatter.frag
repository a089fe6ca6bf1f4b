#version 330
// Light that has entered the skin, spread along one axis of the picture (render/scattering.py: scattering_taps).
uniform sampler2D entered;
uniform sampler2D distances;
uniform vec2 along;       // pixels of a metre at distance 1 [m]
uniform float tap_distances[6];
uniform vec3 tap_shares[6];
uniform float scattering;
uniform vec2 size;
out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float distance_ = texelFetch(distances, pixel, 0).r;
    vec4 own = texelFetch(entered, pixel, 0);
    vec3 sum = tap_shares[0] * own.rgb;
    for (int k = 1; k < 6; ++k) {
        float reach = tap_distances[k] * scattering;
        vec2 offset = along * (reach / distance_);
        for (int side = -1; side <= 1; side += 2) {
            vec2 at = gl_FragCoord.xy + float(side) * offset;
            // What lies farther in front or behind than the light travels is other skin, or none.
            float apart = abs(texelFetch(distances, ivec2(at), 0).r - distance_);
            float same = clamp(2.0 - apart / (2.0 * reach + 1e-4), 0.0, 1.0);
            sum += tap_shares[k] * mix(own.rgb, textureLod(entered, at / size, 0.0).rgb, same);
        }
    }
    // Through hair none of it comes out again.
    colour = vec4(sum, 1.0) * own.a;
}
