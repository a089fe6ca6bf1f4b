// Bumps of fine wrinkles and pores (render/fine_relief.py), without tangents: the slopes along the picture's own axes are
// all that is needed to tilt a normal, however the skin is laid out in texture space.
uniform sampler2D places_in_map;
uniform sampler2D states;   // amplitude of both fine fields, of pores, and the value shown
uniform sampler2D slopes;   // of both fields at full amplitude, along u and v [m for the width of the map]
uniform sampler2D pores;    // slopes of the pores; mean squares of the fields' slopes
uniform sampler2D heights;  // of both fields and pores [mm]; mean square of the pores' slopes
uniform vec3 mean_heights;
uniform float texels;       // along an edge of the map
uniform float metres;       // that edge on the skin
uniform float relief;       // exaggeration

struct Relief {
    vec3 normal;
    float open;          // to the sky, relative to skin as a whole: less at the floor of fine furrows
    float hidden_slope;  // variance of slopes that are too small to be seen, along any axis
    float value;
};

// Skin around a texel sees less of the sky by its depth over about the width of a furrow [1/mm].
const float deepening = 2.2;

Relief relief_at(ivec2 pixel, vec3 place, vec3 n) {
    vec2 at = texelFetch(places_in_map, pixel, 0).xy;
    vec4 state = texelFetch(states, pixel, 0);
    vec3 right = dFdx(place), up = dFdy(place);
    vec2 at_right = dFdx(at), at_up = dFdy(at);
    Relief found = Relief(n, 1.0, 0.0, state.w);
    if (state.z <= 0.0) return found;

    // Where the picture crosses an edge of the body, neighbours lie far apart on the map, and the level is a flat one.
    float level = log2(max(texels * max(length(at_right), length(at_up)), 1e-6));
    vec4 fields = textureLod(slopes, at, level), small = textureLod(pores, at, level);
    vec3 amplitude = relief * state.xyz;
    vec2 slope = amplitude.x * fields.xy + amplitude.y * fields.zw + amplitude.z * small.xy;

    vec3 across_up = cross(up, n), across_right = cross(n, right);
    float area = dot(right, across_up);
    vec3 gradient = (dot(slope, at_right) * across_up + dot(slope, at_up) * across_right)
        / (abs(area) > 1e-16 ? area : 1e-16);
    float steep = length(gradient);
    found.normal = normalize(n - gradient * min(1.0, 1.5 / max(steep, 1e-6)));

    vec4 high = textureLod(heights, at, level);
    vec3 squares = vec3(small.zw, high.w);
    vec3 seen = vec3(dot(fields.xy, fields.xy), dot(fields.zw, fields.zw), dot(small.xy, small.xy)) / (metres * metres);
    found.hidden_slope = 0.5 * dot(amplitude * amplitude, max(squares - seen, 0.0));
    found.open = min(exp(deepening * dot(amplitude, high.xyz - mean_heights)), 1.2);
    return found;
}
