// Light in a layer of strands (Kubelka, Munk 1931): every strand sends `forward` and `back` of the light it meets, and the
// layer ends at something dark. Counts of strands are along the straight way of the light from outside. Strands turn light
// little: light in a layer is as one goes on with the straight rate, to some percent (tests/render/test_pile.py).
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

// What comes back from so many strands behind, as a part of what strands without end send back on both sides.
vec3 closed_by(Pile pile, float behind) {
    return pile.endless * pile.endless * exp(-2.0 * pile.rate * behind);
}

// What goes on at a depth that `before` strands lie before and others follow, as `closed_by` says, as a part of what came in.
vec3 going_on(Pile pile, float before, vec3 closed) {
    vec3 one_way = exp(-pile.rate * before);
    return one_way * (1.0 - closed) / (1.0 - closed * one_way * one_way);
}

// What comes back of light that meets so many strands on its way in.
vec3 sent_back_by(Pile pile, float met) {
    vec3 both_ways = exp(-2.0 * pile.rate * met);
    return pile.endless * (1.0 - both_ways) / (1.0 - pile.endless * pile.endless * both_ways);
}
