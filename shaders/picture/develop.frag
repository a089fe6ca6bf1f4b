#version 330
// Linear light with premultiplied alpha, as a picture in sRGB over the background.
uniform sampler2D linear_picture;
uniform vec3 background;  // linear
uniform vec2 size;
uniform int tone_map;  // 0 soft, 1 filmic, 2 none
out vec4 colour;

// A mild film curve: straight in the shadows, a long soft shoulder. Half of it is taken by the brightness alone, so that
// what is bright pales a little and not to chalk.
vec3 film(vec3 x) {
    float bright = dot(x, vec3(0.2126, 0.7152, 0.0722));
    vec4 curved = vec4(x, bright) * (1.0 + vec4(x, bright) / 18.0) / (1.0 + 0.62 * vec4(x, bright));
    return mix(curved.rgb, x * (curved.a / max(bright, 1e-4)), 0.5);
}

// The curve of film with a toe and a shoulder, as fitted by Narkowicz (2015) to that of the Academy.
vec3 filmic(vec3 x) {
    x *= 0.6;
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

vec3 toned(vec3 x) {
    return tone_map == 0 ? film(x) : tone_map == 1 ? filmic(x) : x;
}

// sRGB's curve with a root and its powers in place of the power, which a processor takes long for; nowhere off by more than
// 0.2 of 255.
vec3 srgb(vec3 c) {
    vec3 r = sqrt(c);
    vec3 curved = (((-0.30957247 * r + 0.84279230) * r - 0.94486161) * r + 1.44789947) * r - 0.03700467;
    return mix(12.92 * c, curved, step(0.0031308, c));
}

void main() {
    vec2 off = (gl_FragCoord.xy / size - vec2(0.5, 0.55)) * vec2(size.x / size.y, 1.0);
    vec3 behind = background * mix(1.25, 0.62, smoothstep(0.0, 0.9, length(off)));
    vec4 light = texelFetch(linear_picture, ivec2(gl_FragCoord.xy), 0);
    vec3 shown = toned(max(light.rgb, 0.0) / max(light.a, 1e-4)) * light.a + behind * (1.0 - light.a);
    colour = vec4(srgb(clamp(shown, 0.0, 1.0)), 1.0);
}
