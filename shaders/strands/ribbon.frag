#version 330
in vec3 v_colour;
in float v_across;
flat in float v_half_width;
out vec4 colour;

// The part of a pixel that a strand covers: thinner than a pixel it becomes coverage.
void main() {
    vec2 pixel = clamp(vec2(v_across - 0.5, v_across + 0.5), -v_half_width, v_half_width);
    float cover = pixel.y - pixel.x;
    colour = vec4(v_colour * cover, cover);
}
