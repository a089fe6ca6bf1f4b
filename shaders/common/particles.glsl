// Textures with a record for every particle (render/particle_texture.py).
const int row = 256;  // records in a row of the texture

// Texel `part` of the record of a particle; a record has `texels` of them.
vec4 record(sampler2D records, int particle, int texels, int part) {
    return texelFetch(records, ivec2((particle % row) * texels + part, particle / row), 0);
}

// Where a particle's own texel lies in a texture with so many rows, for drawing into it.
vec4 place_of(int particle, int rows) {
    vec2 at = (vec2(particle % row, particle / row) + 0.5) / vec2(row, rows);
    return vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
