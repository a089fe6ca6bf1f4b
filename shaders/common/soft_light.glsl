// The soft light between the strands (render/light_volume.py), in the head frame.
uniform sampler3D soft_red;
uniform sampler3D soft_green;
uniform sampler3D soft_blue;
uniform vec3 soft_low;
uniform vec3 soft_size;

// Columns: mean radiance, and its slope along x, y and z; rows: red, green and blue.
mat4x3 soft_light(vec3 place) {
    vec3 at = (place - soft_low) / soft_size;
    return transpose(mat3x4(textureLod(soft_red, at, 0.0), textureLod(soft_green, at, 0.0), textureLod(soft_blue, at, 0.0)));
}
