// The strand texture: opacity in red, tone in green. A billboard shows a window of it.
uniform sampler2D strands;

// Soft towards the sides, so that no billboard shows its edge. x: -1 to 1.
float sides(float x) {
    float t = 1.0 - x * x;
    return t * (2.0 - t);
}

// Strands go on along the strip through the rows before ``ends``, and come to their ends in those behind it.
const float ends = 0.6;

// The row at a place along a billboard, -1 to 1. ending: 0 where its hair goes on at the tipward end, 1 where it ends.
float strip_row(float along, float ending) {
    return 0.5 * ends * (1.0 + along) + (1.0 - ends) * ending;
}

// How much a billboard shows there: it goes over into those that follow it, but not where there are none.
float goes_over(float along, float ending) {
    return 1.0 - along * along * (along > 0.0 ? 1.0 - ending : 1.0);
}

// Opacity of a billboard as the light sees it, local in -1 to 1.
float light_opacity(vec2 local, float window, float window_width) {
    vec2 at = vec2(window + 0.5 * window_width * local.x, strip_row(local.y, 0.0));
    return textureLod(strands, at, 0.0).r * sides(local.x) * goes_over(local.y, 0.0);
}
