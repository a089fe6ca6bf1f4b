// Light that reaches a place: past the objects (shadow map) and through the hair (light map).
uniform sampler2DShadow shadow_map;
uniform sampler2D light_map;

const vec2 disc[8] = vec2[8](
    vec2(-0.326, -0.406), vec2(-0.840, -0.074), vec2(-0.696, 0.457), vec2(-0.203, 0.621),
    vec2(0.962, -0.195), vec2(0.473, -0.480), vec2(0.519, 0.767), vec2(0.185, -0.893));

vec3 light_box(vec3 place) {
    return (light_from_world * vec4(place, 1.0)).xyz * 0.5 + 0.5;
}

// bias [m] towards the light; radius of the soft edge [m].
float past_objects(vec3 place, float bias, float radius) {
    vec3 at = light_box(place + to_light.xyz * bias);
    vec2 reach = vec2(radius / shadow.y);
    float lit = 0.0;
    for (int k = 0; k < 8; ++k) lit += texture(shadow_map, vec3(at.xy + disc[k] * reach, at.z));
    return lit / 8.0;
}

float through_hair(vec3 place, float radius) {
    vec2 at = light_box(place).xy;
    vec2 reach = vec2(radius / shadow.y);
    float light = 0.0;
    for (int k = 0; k < 8; k += 2) light += textureLod(light_map, at + disc[k] * reach, 0.0).r;
    return light / 4.0;
}
