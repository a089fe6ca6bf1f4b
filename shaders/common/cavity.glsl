// Light in a place that sees a part of the sky, ``open``: what hides the rest sends light on, of which a part ``walls`` stays
// each time, as in an integrating sphere. So cavities of skin go red-brown before they go black.
vec3 reaching(float open, vec3 walls) {
    return open / (1.0 - walls * (1.0 - open));
}

// Light of the lamp that comes to a side which faces away from it (n_l: cosine to the lamp) from the walls that face it, as
// from lip to lip.
vec3 sent_across(float open, vec3 walls, float n_l) {
    return (1.0 - open) * max(-n_l, 0.0) * walls;
}
