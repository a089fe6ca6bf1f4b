// How much hair a ray from the light has met (render/deep_opacity.py): a count of strands up to eight depths behind the
// first hair, where count 1 means that the strands crossed together cover the ray once.
uniform sampler2D front;       // depth of the first hair, in the light's box
uniform sampler2D near_counts;  // up to depths 0 to 3
uniform sampler2D far_counts;   // up to depths 4 to 7; the last holds all there is
uniform vec4 near_depths;       // behind the first hair, in the light's box
uniform vec4 far_depths;

// at: in the light's box, 0 to 1. own: what a strand at this very place has added to the count itself.
float hair_crossed(vec3 at, float own) {
    if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at.xy, vec2(1.0)))) return 0.0;
    float depth = at.z - textureLod(front, at.xy, 0.0).r;
    vec4 a = textureLod(near_counts, at.xy, 0.0), b = textureLod(far_counts, at.xy, 0.0);
    float counts[9] = float[9](0.0, a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w);
    float depths[9] = float[9](0.0, near_depths.x, near_depths.y, near_depths.z, near_depths.w,
                               far_depths.x, far_depths.y, far_depths.z, far_depths.w);
    float crossed = 0.0;
    for (int k = 0; k < 8; ++k) {
        float part = clamp((depth - depths[k]) / (depths[k + 1] - depths[k]), 0.0, 1.0);
        crossed += max(counts[k + 1] - counts[k] - (part > 0.0 && part < 1.0 ? own : 0.0), 0.0) * part;
    }
    return crossed;
}

float hair_crossed(vec3 at) {
    return hair_crossed(at, 0.0);
}
