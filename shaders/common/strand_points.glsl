// Points of strands (render/strand_points.py): position in the head frame and radius [m]; direction of the hair.
uniform sampler2D points;
uniform sampler2D tangents;
const int point_row = 2048;

ivec2 texel_of(int point) {
    return ivec2(point % point_row, point / point_row);
}
