#version 330
// The mean of the fine pixels that make up one pixel.
uniform sampler2D fine;
uniform int supersampling;
out vec4 colour;

void main() {
    ivec2 corner = ivec2(gl_FragCoord.xy) * supersampling;
    colour = vec4(0.0);
    for (int k = 0; k < supersampling * supersampling; ++k) {
        colour += texelFetch(fine, corner + ivec2(k % supersampling, k / supersampling), 0);
    }
    colour /= float(supersampling * supersampling);
}
