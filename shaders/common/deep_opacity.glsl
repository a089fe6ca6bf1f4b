// How much hair a ray from the light has met (render/deep_opacity.py): a count of strands up to eight depths behind the
// first hair, where count 1 means that the strands crossed together cover the ray once.
uniform sampler2D front;       // depth of the first hair, in the light's box
uniform sampler2D near_counts;  // up to depths 0 to 3
uniform sampler2D far_counts;   // up to depths 4 to 7; the last holds all there is
uniform vec4 near_depths;       // behind the first hair, in the light's box
uniform vec4 far_depths;
uniform float opaque;           // by what the logarithm of light that strands let past falls with the count

// The count at one texel, which has a first hair of its own, and how fast it grows there with the depth, both in units of
// the box; rates: one over what layers are deep.
vec2 crossed_at(ivec2 texel, float z, float own, vec4 near_rates, vec4 far_rates) {
    float depth = z - texelFetch(front, texel, 0).r;
    vec4 near = texelFetch(near_counts, texel, 0), far = texelFetch(far_counts, texel, 0);
    float all_near = near.w;
    vec4 near_part = clamp(1.0 + (depth - near_depths) * near_rates, 0.0, 1.0);
    vec4 far_part = clamp(1.0 + (depth - far_depths) * far_rates, 0.0, 1.0);
    vec4 near_here = vec4(greaterThan(near_part * (1.0 - near_part), vec4(0.0)));
    vec4 far_here = vec4(greaterThan(far_part * (1.0 - far_part), vec4(0.0)));
    near = max(near - vec4(0.0, near.xyz) - own * near_here, 0.0);
    far = max(far - vec4(all_near, far.xyz) - own * far_here, 0.0);
    return vec2(dot(near, near_part) + dot(far, far_part),
                dot(near, near_here * near_rates) + dot(far, far_here * far_rates));
}

// One of the four texels beside a place, and its share of what is read there.
float beside(vec2 at, int k, out ivec2 texel) {
    ivec2 last = textureSize(front, 0) - 1;
    vec2 place = at * vec2(last + 1) - 0.5;
    ivec2 low = clamp(ivec2(floor(place)), ivec2(0), last);
    bvec2 upper = bvec2(k % 2 == 1, k > 1);
    vec2 part = clamp(place - vec2(low), 0.0, 1.0), share = mix(1.0 - part, part, upper);
    texel = min(low + ivec2(upper), last);
    return share.x * share.y;
}

// at: in the light's box, 0 to 1. own: what a strand at this very place has added to the count itself.
vec2 hair_crossed(vec3 at, float own) {
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return vec2(0.0);
    vec4 near_rates = 1.0 / (near_depths - vec4(0.0, near_depths.xyz));
    vec4 far_rates = 1.0 / (far_depths - vec4(near_depths.w, far_depths.xyz));
    vec2 crossed = vec2(0.0);
    ivec2 texel;
    for (int k = 0; k < 4; ++k) {
        float share = beside(at.xy, k, texel);
        crossed += share * crossed_at(texel, at.z, own, near_rates, far_rates);
    }
    return crossed;
}

float hair_crossed(vec3 at) {
    return hair_crossed(at, 0.0).x;
}

// Of the light at the depth `from` what is left at a place, where its logarithm falls by `taken` with the count. A strand is
// there or not: what comes through is worked out for each texel, and not for the mean of their counts.
vec3 through_hair(vec3 at, float from, vec3 taken) {
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return vec3(1.0);
    vec4 near_rates = 1.0 / (near_depths - vec4(0.0, near_depths.xyz));
    vec4 far_rates = 1.0 / (far_depths - vec4(near_depths.w, far_depths.xyz));
    vec3 through = vec3(0.0);
    ivec2 texel;
    for (int k = 0; k < 4; ++k) {
        float share = beside(at.xy, k, texel);
        float crossed = crossed_at(texel, at.z, 0.0, near_rates, far_rates).x
            - crossed_at(texel, from, 0.0, near_rates, far_rates).x;
        through += share * exp(-taken * max(crossed, 0.0));
    }
    return through;
}

// The part of straight light that comes past the strands.
float past_hair(vec3 at) {
    return through_hair(at, 0.0, vec3(opaque)).r;
}
