// The strand texture: opacity in red, tone in green. A billboard shows a window of it.
uniform sampler2D strands;

// Soft towards the sides, so that no billboard shows its edge. x: -1 to 1.
float sides(float x) {
    float t = 1.0 - x * x;
    return t * (2.0 - t);
}

// Opacity of a billboard as the light sees it, local in -1 to 1.
float light_opacity(vec2 local, float window, float window_width) {
    vec2 at = vec2(window + 0.5 * window_width * local.x, 0.5 + 0.5 * local.y);
    return textureLod(strands, at, 0.0).r * sides(local.x);
}
