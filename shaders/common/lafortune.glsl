// Lafortune's model (render/lafortune.py, which has the figures): lobe by lobe, then red, green and blue.
uniform vec3 lobe_across[3];
uniform vec3 lobe_along[3];
uniform vec3 lobe_exponents[3];

// What the lobes reflect [1/sr]. u, v: unit, away from the skin, to the light and to the eye; n: its normal.
vec3 lafortune_lobes(vec3 u, vec3 v, vec3 n) {
    float along = dot(u, n) * dot(v, n), across = dot(u, v) - along;
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 3; ++k)
        sum += pow(max(lobe_across[k] * across + lobe_along[k] * along, 0.0), lobe_exponents[k]);
    return sum;
}
