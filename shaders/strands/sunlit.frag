#version 330
// The part of the parallel light that reaches a place past the body and through the hair.
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/shadow.glsl"
#include "common/deep_opacity.glsl"
#include "common/pile.glsl"
#include "common/through_hair.glsl"
uniform sampler2D receivers;  // places in the head frame [m]
uniform mat4 hair_box;        // of the light, around the hair alone, from the world
out vec4 lit;

void main() {
    vec3 place = turned(texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz, head_turn.xyz) + head_shift.xyz;
    place += to_light.xyz * 0.001;
    vec3 in_hair = (hair_box * vec4(place, 1.0)).xyz * 0.5 + 0.5;
    lit = vec4(past_objects_at(light_box(place), 0.001) * through_hair(crossed_beside(in_hair, vec4(0.0))), 1.0);
}
