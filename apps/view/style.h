// Styles: how heights become colours. Data, not code: data/styles/*.json.
#pragma once

#include <string>

#include "apps/view/view.h"
#include "shaders/shared.h"

namespace oro {

// A style ready for the GPU, and the sun it is lit by.
struct Style {
    gpu::FrameStyle frame;
    SunDirection sun;
};

// True for a path (ending in .json, or with a folder), false for a name in the data folder.
bool is_style_path(const std::string& style);

// Lets that sun light a frame; colours stay.
void light_by(const SunDirection& sun, gpu::FrameStyle& style);

// A style by name (in the data folder) or by path (ending in .json), lit by the view's sun where it has one.
// Colours are turned from sRGB to linear light. Errors: no such style, or what is wrong in it.
Result<Style> load_style(const std::string& name, const std::optional<SunDirection>& sun);

}  // namespace oro
