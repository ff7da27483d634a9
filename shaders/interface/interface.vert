// What is drawn over a window's picture: corners in pixels, with a place in the atlas of letters and a colour.
#version 460

layout(push_constant) uniform Push {
    vec2 scale;  // from pixels to the clip square
    vec2 shift;
};
layout(location = 0) in vec2 at_px;
layout(location = 1) in vec2 in_atlas;
layout(location = 2) in vec4 colour;  // sRGB-encoded, as the picture is
layout(location = 0) out vec2 fragment_in_atlas;
layout(location = 1) out vec4 fragment_colour;

void main() {
    fragment_in_atlas = in_atlas;
    fragment_colour = colour;
    gl_Position = vec4(at_px * scale + shift, 0.0, 1.0);
}
