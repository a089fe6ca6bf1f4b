// Brows: hairs that lie outwards and up, in fine strokes that stand thinner towards the rim. hair: the hair texture.

// Where a place of the head at rest [m] is across the hairs [m].
float across_brow(vec3 rest) {
    return 0.6 * abs(rest.x) - 0.8 * rest.y;
}

// How much of the skin they cover. painted: of the vertices, 0 to 1.
float brow_cover(float painted, float across, sampler2D hair) {
    vec2 strand = textureLod(hair, vec2(23.0 * across, 0.3), 0.0).rg;
    float stroke = min(1.6 * strand.r * strand.g, 1.0);
    float thick = painted * smoothstep(0.0, 0.55, painted);
    return min(1.3 * thick * (0.6 + 0.4 * stroke), 0.95);
}
