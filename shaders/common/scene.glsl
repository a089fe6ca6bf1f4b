// What every shader knows about the frame; byte for byte SCENE_DTYPE of render/scene_block.py.
layout(std140) uniform Scene {
    mat4 clip_from_world;
    mat4 light_from_world;
    vec4 eye;         // xyz [m]
    vec4 to_light;    // xyz, unit
    vec4 radiance;    // rgb of the parallel light
    vec4 sky;         // rgb of the soft light from above
    vec4 ground;      // rgb of the soft light from below
    vec4 head_turn;   // rotation vector of the head [rad]
    vec4 head_shift;  // translation of the bust [m]
    vec4 shadow;      // shadows on; depth of the light's box [m]; near and far plane of the camera [m]
};
