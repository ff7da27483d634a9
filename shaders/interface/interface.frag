// The atlas holds how much of a pixel a letter covers; one of its places is wholly covered, for areas and lines.
#version 460

layout(set = 0, binding = 0) uniform sampler2D atlas;
layout(location = 0) in vec2 fragment_in_atlas;
layout(location = 1) in vec4 fragment_colour;
layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(fragment_colour.rgb, fragment_colour.a * texture(atlas, fragment_in_atlas).r);
}
