#version 330
// Linear light with premultiplied alpha, as a picture in sRGB over the background.
uniform sampler2D linear_picture;
uniform vec3 background;  // linear
uniform vec2 size;
uniform int supersampling;
out vec4 colour;

// A mild film curve: straight in the shadows, a long soft shoulder, white at about 6.
vec3 film(vec3 x) {
    return x * (1.0 + x / 18.0) / (1.0 + 0.62 * x);
}

vec3 srgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
    vec2 off = (gl_FragCoord.xy / size - vec2(0.5, 0.55)) * vec2(size.x / size.y, 1.0);
    vec3 behind = background * mix(1.25, 0.62, smoothstep(0.0, 0.9, length(off)));
    ivec2 corner = ivec2(gl_FragCoord.xy) * supersampling;
    vec3 shown = vec3(0.0);
    for (int k = 0; k < supersampling * supersampling; ++k) {
        vec4 light = texelFetch(linear_picture, corner + ivec2(k % supersampling, k / supersampling), 0);
        shown += film(max(light.rgb, 0.0) / max(light.a, 1e-4)) * light.a + behind * (1.0 - light.a);
    }
    colour = vec4(srgb(clamp(shown / float(supersampling * supersampling), 0.0, 1.0)), 1.0);
}
