// How one hair scatters light, from the tables of render/fibre.py. Lobes: R, TT, TRT, TRRT and on.
uniform sampler3D around_table;  // A times N over phi, sine of theta, coded absorption
uniform sampler3D spread_table;  // the same for light from anywhere within a quarter turn
uniform sampler2D back_table;    // what is turned back over sine of theta, coded absorption, by parts of the azimuth
uniform sampler2D forward_table; // and what goes on
uniform vec4 variances;
uniform vec4 tilt_cos;
uniform vec4 tilt_sin;
const float coded_most = 0.98;

// I0(x) exp(-x), Abramowitz and Stegun 9.8.1 and 9.8.2; x >= 0.
vec4 bessel_scaled(vec4 x) {
    vec4 t = min(x / 3.75, 1.0), u = 3.75 / max(x, 3.75);
    t *= t;
    vec4 low = 1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))));
    vec4 high = 0.39894228 + u * (0.01328592 + u * (0.00225319 + u * (-0.00157565 + u * (0.00916281 + u * (-0.02057706
        + u * (0.02635537 + u * (-0.01647633 + u * 0.00392377)))))));
    return mix(low * exp(-min(x, vec4(3.75))), high * inversesqrt(max(x, vec4(3.75))), step(3.75, x));
}

// M of the four lobes (d'Eon et al. 2011, eq. 7), each `wider` in variance.
vec4 along_hair(float sin_in, float sin_out, vec4 wider) {
    vec4 v = variances + wider;
    float cos_in = sqrt(max(1.0 - sin_in * sin_in, 0.0)), cos_out = sqrt(max(1.0 - sin_out * sin_out, 0.0));
    vec4 leaning = sin_out * tilt_cos + cos_out * tilt_sin;
    vec4 leaning_cos = sqrt(max(1.0 - leaning * leaning, 0.0));
    vec4 cosines = cos_in * leaning_cos;
    vec4 scale = 1.0 / (v * (1.0 - exp(-2.0 / v)));
    return bessel_scaled(cosines / v) * exp((cosines - sin_in * leaning - 1.0) / v) * scale;
}

vec3 coded(vec3 absorption) {
    return absorption / (1.0 + absorption) / coded_most;
}

float texel_place(float x, int count) {
    return (x * float(count - 1) + 0.5) / float(count);
}

// A times N per lobe for red, green and blue, weighted with M.
vec3 around_hair(sampler3D table, float phi, float sin_out, vec3 absorption, vec4 along) {
    vec2 at = vec2(phi / 3.14159265, abs(sin_out));
    int count = textureSize(table, 0).z;
    vec3 place = coded(absorption);
    return vec3(dot(along, textureLod(table, vec3(at, texel_place(place.r, count)), 0.0)),
                dot(along, textureLod(table, vec3(at, texel_place(place.g, count)), 0.0)),
                dot(along, textureLod(table, vec3(at, texel_place(place.b, count)), 0.0)));
}

// Of the light at this inclination what a strand sends on, by the azimuth that it comes from: four parts of the quarter turn
// from straight back, and from straight on.
struct Sent {
    mat4x3 back;
    mat4x3 forward;
};

const vec4 part_cos = vec4(0.98078528, 0.83146961, 0.55557023, 0.19509032);  // of the middles of the parts
const vec4 part_cos_twice = vec4(0.92387953, 0.38268343, -0.38268343, -0.92387953);

mat4x3 sent_by(sampler2D table, float sine, vec3 place) {
    int count = textureSize(table, 0).y;
    return transpose(mat3x4(textureLod(table, vec2(abs(sine), texel_place(place.r, count)), 0.0),
                            textureLod(table, vec2(abs(sine), texel_place(place.g, count)), 0.0),
                            textureLod(table, vec2(abs(sine), texel_place(place.b, count)), 0.0)));
}

Sent sent_on(float sine, vec3 absorption) {
    vec3 place = coded(absorption);
    return Sent(sent_by(back_table, sine, place), sent_by(forward_table, sine, place));
}

// What a strand sends forward and back of light from everywhere above (render/fibre.py: sent_on).
vec3 on(Sent sent) {
    return 0.5 * (sent.forward * (1.0 + part_cos) + sent.back * (1.0 - part_cos));
}

vec3 back(Sent sent) {
    return 0.5 * (sent.forward * (1.0 - part_cos) + sent.back * (1.0 + part_cos));
}
