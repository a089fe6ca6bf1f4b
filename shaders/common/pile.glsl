// Light in a layer of strands (Kubelka, Munk 1931): every strand sends `forward` and `back` of the light it meets, and the
// layer ends at something dark. Counts of strands are along the straight way of the light from outside. Light that was
// scattered goes on at all azimuths about the strands, and meets pi / 2 as many on the way to the same depth.
const float roundabout = 1.57079633;
const float least_kept = 1e-4;

struct Pile {
    vec3 rate;     // by what light grows less for each strand it meets
    vec3 endless;  // what strands without end send back
};

Pile pile(vec3 forward, vec3 back) {
    vec3 kept = max(1.0 - forward - back, least_kept), b = max(back, least_kept);
    vec3 rate = sqrt(kept * (kept + 2.0 * b));
    return Pile(rate, (kept + b - rate) / b);
}

// What is let through of light that meets so many strands.
vec3 let_through_by(Pile pile, float met) {
    vec3 square = pile.endless * pile.endless, one_way = exp(-pile.rate * met);
    return one_way * (1.0 - square) / (1.0 - square * one_way * one_way);
}

// What goes on at a depth that `before` strands lie before and `behind` others follow, as a part of what came in.
vec3 going_on(Pile pile, float before, float behind) {
    vec3 rate = roundabout * pile.rate, square = pile.endless * pile.endless;
    return exp(-rate * before) * (1.0 - square * exp(-2.0 * rate * behind))
        / (1.0 - square * exp(-2.0 * rate * (before + behind)));
}

// And with the light that passes between the strands, which is never less.
vec3 passing(Pile pile, float before, float behind) {
    return max(going_on(pile, before, behind), exp(-before));
}

// What comes back of light that meets so many strands on its way in.
vec3 sent_back_by(Pile pile, float met) {
    vec3 both_ways = exp(-2.0 * pile.rate * met);
    return pile.endless * (1.0 - both_ways) / (1.0 - pile.endless * pile.endless * both_ways);
}
