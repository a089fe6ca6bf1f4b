// Turns a vector by a rotation vector (Rodrigues), as scipy's Rotation.from_rotvec does.
vec3 turned(vec3 v, vec3 turn) {
    float angle = length(turn);
    if (angle < 1e-7) return v + cross(turn, v);
    vec3 axis = turn / angle;
    float c = cos(angle);
    return v * c + cross(axis, v) * sin(angle) + axis * (dot(axis, v) * (1.0 - c));
}
