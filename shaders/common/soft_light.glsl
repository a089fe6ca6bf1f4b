// The soft light between the strands (render/light_volume.py, render/soft_light.py), in the head frame.
uniform sampler3D soft_volumes;
uniform vec3 soft_low;
uniform vec3 soft_size;
uniform float filling;  // how fast a pile of hair fills with the count of strands (render/fibre.py)
const int soft_count = 8;

// Radiance from the direction d is mean + slope * d + d . (bend * d), for red, green and blue.
struct SoftLight {
    vec3 mean;
    mat3 slope;      // columns: along x, y and z
    mat3 bend[3];    // of red, green and blue
    vec4 hair;       // how much of it there is: mean, and slope along x, y and z
};

vec4 soft_numbers(vec3 at, int k) {
    return textureLod(soft_volumes, vec3(at.xy, (at.z + float(k)) / float(soft_count)), 0.0);
}

mat3 symmetric(vec4 part, float last) {
    return mat3(part.x, part.z, part.w, part.z, part.y, last, part.w, last, -part.x - part.y);
}

SoftLight soft_light(vec3 place) {
    // No volume is read beyond its last node, where the next one begins.
    float rim = 0.5 * float(soft_count) / float(textureSize(soft_volumes, 0).z);
    vec3 at = (place - soft_low) / soft_size;
    at.z = clamp(at.z, rim, 1.0 - rim);
    mat3x4 first = mat3x4(soft_numbers(at, 0), soft_numbers(at, 1), soft_numbers(at, 2));
    mat4x3 mean_and_slope = transpose(first);
    vec4 last = soft_numbers(at, 6);
    return SoftLight(mean_and_slope[0], mat3(mean_and_slope[1], mean_and_slope[2], mean_and_slope[3]),
                     mat3[3](symmetric(soft_numbers(at, 3), last.r), symmetric(soft_numbers(at, 4), last.g),
                             symmetric(soft_numbers(at, 5), last.b)),
                     soft_numbers(at, 7));
}

// dot(a, bend * b) for red, green and blue.
vec3 bend_along(SoftLight light, vec3 a, vec3 b) {
    return vec3(dot(a, light.bend[0] * b), dot(a, light.bend[1] * b), dot(a, light.bend[2] * b));
}

// How many strands there are in a direction.
float strands_towards(SoftLight light, vec3 direction) {
    float filled = clamp(light.hair.x + dot(light.hair.yzw, direction), 0.0, 0.97);
    return filled / (1.0 - filled) / filling;
}
