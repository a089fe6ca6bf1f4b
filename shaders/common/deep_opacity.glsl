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

// What the four texels beside a place say, and how much each of them has to say.
struct Crossed {
    vec4 firsts;  // the first hair: met at once, but for those it stands for, which lie anywhere within its width
    vec4 counts;  // with it all hair; what follows in its layer is met little by little
    vec4 rates;   // how fast counts grow there with the depth, in units of the box
    vec4 depths;  // behind the first hair
    vec4 shares;
};

// At one texel, which has a first hair of its own: first, count, rate and depth.
vec4 crossed_at(ivec2 texel, float z, float own) {
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
    return vec4(first, first + dot(near, near_part) + dot(far, far_part),
                dot(near, near_here * near_rates) + dot(far, far_here * far_rates), depth);
}

// at: in the light's box, 0 to 1. own: what a strand at this very place has added to the count itself.
Crossed crossed_beside(vec3 at, float own) {
    Crossed crossed = Crossed(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.25));
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return crossed;
    ivec2 last = textureSize(front, 0) - 1;
    vec2 place = at.xy * vec2(last + 1) - 0.5;
    ivec2 low = clamp(ivec2(floor(place)), ivec2(0), last);
    vec2 part = clamp(place - vec2(low), 0.0, 1.0);
    for (int k = 0; k < 4; ++k) {
        bvec2 upper = bvec2(k % 2 == 1, k > 1);
        vec2 share = mix(1.0 - part, part, upper);
        vec4 found = crossed_at(min(low + ivec2(upper), last), at.z, own);
        crossed.firsts[k] = found.x;
        crossed.counts[k] = found.y;
        crossed.rates[k] = found.z;
        crossed.depths[k] = found.w;
        crossed.shares[k] = share.x * share.y;
    }
    return crossed;
}

// The count in the mean.
float hair_crossed(vec3 at) {
    Crossed crossed = crossed_beside(at, 0.0);
    return dot(crossed.counts, crossed.shares);
}

// The part of straight light that comes past the strands. A strand is there or not: what comes through is worked out for each
// texel, and not for the mean of their counts.
float past_hair(vec3 at) {
    Crossed crossed = crossed_beside(at, 0.0);
    return dot(crossed.shares, exp(-opaque * crossed.counts));
}
