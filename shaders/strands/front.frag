#version 330
// The nearest depth around every texel: reading between texels then never lies behind the first hair.
uniform sampler2D nearest;
out float front;

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(nearest, 0) - 1;
    front = 1.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            front = min(front, texelFetch(nearest, clamp(here + ivec2(x, y), ivec2(0), last), 0).r);
}
