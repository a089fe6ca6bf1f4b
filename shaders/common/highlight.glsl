float fifth(float x) {
    float square = x * x;
    return square * square * x;
}

// Microfacets of one roughness: distribution and shadowing.
float lobe(float n_h, float n_l, float n_v, float roughness) {
    float a2 = roughness * roughness * roughness * roughness;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float k = roughness * roughness * 0.5;
    return a2 / (3.14159 * d * d) / (4.0 * mix(n_l, 1.0, k) * mix(n_v, 1.0, k));
}
