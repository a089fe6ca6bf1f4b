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

// From pixel to pixel so much farther away [m] is another place, or none.
const float elsewhere = 0.1;

// Half the square of the slope that normals have within a pixel (as Tokuyoshi and Kaplanyan 2019 take it from pixel to pixel):
// a highlight that is smaller than a pixel is spread over it, where it would shine in some pixels and be lost in others.
float slope_in_pixel(vec3 normal, float distance_) {
    vec3 right = abs(dFdx(distance_)) < elsewhere ? dFdx(normal) : vec3(0.0);
    vec3 up = abs(dFdy(distance_)) < elsewhere ? dFdy(normal) : vec3(0.0);
    return min(0.25 * (dot(right, right) + dot(up, up)), 0.09);
}

// A roughness with slopes that are too fine to be seen; hidden_slope: half their square.
float roughened(float roughness, float hidden_slope) {
    float square = roughness * roughness;
    return sqrt(sqrt(square * square + 2.0 * hidden_slope));
}
