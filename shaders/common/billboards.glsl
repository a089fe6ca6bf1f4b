// Billboards as the light sees them, nearest first: BILLBOARD_DTYPE of render/light_billboards.py.
uniform sampler2D billboards;
const int row = 256;

vec4 billboard(int rank, int part) {
    return texelFetch(billboards, ivec2((rank % row) * 3 + part, rank / row), 0);
}
