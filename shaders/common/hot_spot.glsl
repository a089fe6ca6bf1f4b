// What is seen is lit more often than not: of the strands on the way of the light to a place, those that would hide it from
// the eye, too, are known not to be there (the hot spot of leaves, Kuusk 1985, here for strands side by side, which are
// circles across). A strand can stand in both ways up to radius / tan(phi / 2) from the place, phi being the azimuth
// between them; of those nearer half do, in the mean.
// radius_count: how many strands are met within a radius.
float crossed_unseen(float crossed, float radius_count, float phi) {
    float within = radius_count * max(cos(0.5 * phi), 0.0) / max(sin(0.5 * phi), 1e-3);
    return crossed < within ? 0.5 * crossed * crossed / within : crossed - 0.5 * within;
}
