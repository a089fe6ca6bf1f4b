// What is seen is lit more often than not: of the strands on the way of the light to a place, those that would hide it from
// the eye, too, are known not to be there (the hot spot of leaves, Kuusk 1985, here for strands side by side, which are
// circles across). A strand can stand in both ways up to radius / tan(phi / 2) from the place, phi being the azimuth
// between them; of those nearer half do, in the mean.
// radius_count: how many strands are met within a radius, of `crossed` that stand anywhere on the way.
float crossed_unseen(float crossed, float radius_count, float phi) {
    float within = radius_count * max(cos(0.5 * phi), 0.0) / max(sin(0.5 * phi), 1e-3);
    return crossed < within ? 0.5 * crossed * crossed / within : crossed - 0.5 * within;
}

// And of strands that are met so many radii away.
vec4 met_unseen(vec4 strands, vec4 radii, float phi) {
    return strands * clamp(radii * tan(min(0.5 * phi, 1.57)), 0.0, 1.0);
}

// How many times as bright soft light from the eye's side is at what is seen as in the mean over all that is there. It has met
// `met` strands, of which each takes the part `rate`. The mean over a quarter turn from the eye, by Gauss.
vec3 unseen_gain(vec3 met, vec3 rate, float radius_count) {
    const vec3 phi = vec3(0.177, 0.785, 1.394), share = vec3(5.0, 8.0, 5.0) / 18.0;
    vec3 gain = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        vec3 crossed = vec3(crossed_unseen(met.r, radius_count, phi[k]), crossed_unseen(met.g, radius_count, phi[k]),
                            crossed_unseen(met.b, radius_count, phi[k]));
        gain += share[k] * exp(rate * (met - crossed));
    }
    return gain;
}
