// What a map of hair lets through, after common/deep_opacity.glsl and common/pile.glsl.
uniform vec3 rate;          // of a pile of this hair, for the counts in the map (render/deep_opacity.py: let_through)
uniform vec3 endless;
uniform vec3 less_rate;     // and of one that sends less on (render/fibre.py: followed)
uniform vec3 less_endless;

// A strand is there or not: what comes through is worked out for each texel, and not for the mean of their counts.
vec3 through_hair(Crossed crossed) {
    vec3 through = vec3(0.0);
    for (int k = 0; k < 4; ++k) {
        float count = crossed.counts[k];
        vec3 by_way = 2.0 * let_through_by(Pile(rate, endless), count) - let_through_by(Pile(less_rate, less_endless), count);
        through += crossed.shares[k] * max(by_way, exp(-opaque * count));
    }
    return through;
}
