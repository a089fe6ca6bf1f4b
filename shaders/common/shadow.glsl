// Light that reaches what is not hair: past the objects (shadow map) and through the hair (light map with soft edges).
uniform sampler2DShadow shadow_map;
uniform sampler2D light_map;

const vec2 disc[5] = vec2[5](
    vec2(0.15, -0.12), vec2(0.80, 0.30), vec2(-0.42, 0.82), vec2(-0.85, -0.25), vec2(0.28, -0.88));

vec3 light_box(vec3 place) {
    return (light_from_world * vec4(place, 1.0)).xyz * 0.5 + 0.5;
}

// at: in the light's box, 0 to 1; radius of the soft edge [m].
float past_objects_at(vec3 at, float radius) {
    float reach = radius / shadow.y;
    float lit = 0.0;
    for (int k = 0; k < 5; ++k) lit += textureLod(shadow_map, vec3(at.xy + disc[k] * reach, at.z), 0.0);
    return lit * 0.2;
}

// bias [m] towards the light; radius of the soft edge of objects [m].
float light_at(vec3 place, float bias, float radius) {
    if (shadow.x < 0.5) return 1.0;
    vec3 at = light_box(place + to_light.xyz * bias);
    return past_objects_at(at, radius) * textureLod(light_map, at.xy, 0.0).r;
}
