#version 330
// How far away the body is at every pixel [m], so that hair can lie on it.
#include "common/scene.glsl"
uniform sampler2D depth;
out float distance_;

void main() {
    float near = shadow.z, far = shadow.w;
    float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r;
    distance_ = near * far / (far - z * (far - near));
}
