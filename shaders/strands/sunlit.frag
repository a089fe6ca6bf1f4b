#version 330
// The part of the parallel light that reaches a place past the body and through the hair.
#include "common/scene.glsl"
#include "common/pose.glsl"
#include "common/shadow.glsl"
#include "common/deep_opacity.glsl"
#include "common/pile.glsl"
uniform sampler2D receivers;  // places in the head frame [m]
uniform mat4 hair_box;        // of the light, around the hair alone, from the world
uniform vec3 sent_forward;    // by a strand, of the light it meets
uniform vec3 sent_back;
out vec4 lit;

void main() {
    vec3 place = turned(texelFetch(receivers, ivec2(gl_FragCoord.xy), 0).xyz, head_turn.xyz) + head_shift.xyz;
    place += to_light.xyz * 0.001;
    vec3 in_hair = (hair_box * vec4(place, 1.0)).xyz * 0.5 + 0.5;
    vec3 through = max(going_on(pile(sent_forward, sent_back), hair_crossed(in_hair), 0.0), past_hair(in_hair));
    lit = vec4(past_objects_at(light_box(place), 0.001) * through, 1.0);
}
