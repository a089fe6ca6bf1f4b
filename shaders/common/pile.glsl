// Light in a layer of strands (Kubelka, Munk 1931): every strand sends `forward` and `back` of the light it meets, and the
// layer ends at something dark. Counts of strands are along the straight way of the light from outside. Light that was
// scattered goes on at all azimuths about the strands, and meets pi / 2 as many on the way to the same depth.
const float roundabout = 1.57079633;

// What goes on at a depth that `before` strands lie before and `behind` others follow, as a part of what came in.
vec3 going_on(vec3 forward, vec3 back, float before, float behind) {
    vec3 kept = max(1.0 - forward - back, 1e-4), b = max(back, 1e-4);
    vec3 rate = sqrt(kept * (kept + 2.0 * b));
    vec3 endless = (kept + b - rate) / b, square = endless * endless;
    rate *= roundabout;
    return exp(-rate * before) * (1.0 - square * exp(-2.0 * rate * behind))
        / (1.0 - square * exp(-2.0 * rate * (before + behind)));
}

// And with the light that passes between the strands, which is never less.
vec3 passing(vec3 forward, vec3 back, float before, float behind) {
    return max(going_on(forward, back, before, behind), exp(-before));
}
