// How much hair a ray from the light has met (render/deep_opacity.py): a count of strands up to eight depths behind the
// first hair, where count 1 means that the strands crossed together cover the ray once.
uniform sampler2D front;       // depth of the first hair, in the light's box
uniform sampler2D near_counts;  // up to depths 0 to 3
uniform sampler2D far_counts;   // up to depths 4 to 7; the last holds all there is
uniform vec4 near_depths;       // behind the first hair, in the light's box
uniform vec4 far_depths;
uniform vec4 near_rates;        // one over what layers are deep
uniform vec4 far_rates;
uniform float first_rate;       // one over how deep those lie that the first hair stands for
uniform float cover;            // the part of a texel that a strand covers, in the mean
uniform float opaque;           // by what the logarithm of light that strands let past falls with the count
const float most_taken = 0.98;  // of the light, by one strand in the logarithm (render/deep_opacity.py)

// What the four texels beside a place say, and how much each of them has to say.
struct Crossed {
    vec4 counts;
    vec4 shares;
};

// At one texel, which has a first hair of its own. That is met at once, but for those it stands for, which lie anywhere within
// its width; what follows in its layer is met little by little.
float crossed_at(ivec2 texel, float z, float own) {
    float depth = z - texelFetch(front, texel, 0).r;
    vec4 near = texelFetch(near_counts, texel, 0), far = texelFetch(far_counts, texel, 0);
    float all_near = near.w;
    vec4 near_part = clamp(1.0 + (depth - near_depths) * near_rates, 0.0, 1.0);
    vec4 far_part = clamp(1.0 + (depth - far_depths) * far_rates, 0.0, 1.0);
    vec4 near_here = vec4(greaterThan(near_part * (1.0 - near_part), vec4(0.0)));
    vec4 far_here = vec4(greaterThan(far_part * (1.0 - far_part), vec4(0.0)));
    float first = min(cover, near.x);
    near = max(near - vec4(first, near.xyz) - own * near_here, 0.0);
    far = max(far - vec4(all_near, far.xyz) - own * far_here, 0.0);
    first *= clamp(depth * first_rate, 0.0, 1.0);
    return first + dot(near, near_part) + dot(far, far_part);
}

// The texels beside a place in the light's box, 0 to 1: from the lower corner on, those with k % 2 and k / 2 more.
struct Beside {
    ivec2 low;
    ivec2 last;
    vec2 place;  // in texels, from the middle of the first
};

Beside texels_beside(vec2 at) {
    ivec2 last = textureSize(front, 0) - 1;
    vec2 place = at * vec2(last + 1) - 0.5;
    return Beside(clamp(ivec2(floor(place)), ivec2(0), last), last, place);
}

ivec2 texel_beside(Beside beside, int k) {
    return min(beside.low + ivec2(k % 2, k / 2), beside.last);
}

// What a strand at a place has added to the counts of the four texels beside it (strands/opacity.vert draws it). along: its
// direction in the light's box; half_width: as it is drawn into the map, in texels.
vec4 own_counts(vec2 at, vec2 along, float half_width) {
    Beside beside = texels_beside(at);
    vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-9);
    float drawn = max(half_width, 0.5);
    vec4 own;
    for (int k = 0; k < 4; ++k) {
        vec2 aside = vec2(texel_beside(beside, k)) - beside.place;
        own[k] = abs(dot(aside, across)) < drawn ? half_width / drawn : 0.0;
    }
    return own;
}

// at: in the light's box, 0 to 1. own: what a strand at this very place has added to the counts itself.
Crossed crossed_beside(vec3 at, vec4 own) {
    Crossed crossed = Crossed(vec4(0.0), vec4(0.25));
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return crossed;
    Beside beside = texels_beside(at.xy);
    vec2 part = clamp(beside.place - vec2(beside.low), 0.0, 1.0);
    for (int k = 0; k < 4; ++k) {
        vec2 share = mix(1.0 - part, part, bvec2(k % 2 == 1, k > 1));
        crossed.counts[k] = crossed_at(texel_beside(beside, k), at.z, own[k]);
        crossed.shares[k] = share.x * share.y;
    }
    return crossed;
}

// By what the logarithm of light falls with the count where a strand takes the parts `lost` of it (render/deep_opacity.py).
vec3 taken(vec3 lost) {
    return -log(1.0 - min(cover * lost, most_taken)) / cover;
}

// The count in the mean.
float hair_crossed(vec3 at) {
    Crossed crossed = crossed_beside(at, vec4(0.0));
    return dot(crossed.counts, crossed.shares);
}

// The part of straight light that comes past the strands. A strand is there or not: what comes through is worked out for each
// texel, and not for the mean of their counts.
float past_hair(vec3 at) {
    Crossed crossed = crossed_beside(at, vec4(0.0));
    return dot(crossed.shares, exp(-opaque * crossed.counts));
}
