// Styles: how the ground becomes colours. Data, not code: data/styles/*.json, and colour tables of GDAL.
#pragma once

#include <string>
#include <vector>

#include "apps/styles/style.h"
#include "apps/view/view.h"

namespace oro {

// gpu::show_... of the same.
gpu::uint shown_by(Show show);

// The names of the styles that come with the program, natural first; none where there are none.
std::vector<std::string> style_names();

// True for a path (ending in .json or .txt, or with a folder), false for a name in the data folder.
bool is_style_path(const std::string& style);

// The name of a style that had another in older views and scripts: `haze` was `default` before `natural` was
// drawn where nobody asked. All other names and paths stay.
std::string present_name(const std::string& style);

// Whether a view in its style that asks for no sun has the usual one of its place. False, too, where there is
// no such style: load_style() says so. What the style's file holds is kept for that.
bool has_sun_by_place(View& view);

// Lets that sun light a frame; colours stay.
void light_by(const SunDirection& sun, gpu::FrameStyle& style);

// A view's style, by name (in the data folder) or by path (.json, or .txt: a colour table of GDAL), lit by
// the view's sun where it has one; `field` is what the view looks at. Colours are turned from sRGB to linear
// light. Errors: no such style, or what is wrong in it; posts that cannot be read.
// light: shadows and the light of the sky look over the ground in all directions. Of made terrain whose posts
// are made where they are looked at, only pictures that are known beforehand (known_pictures()) have them
// unasked, from an eye at most 1,000 m above the highest ground and at most 75 degrees from the equator;
// others are left without unless the view asks for them.
enum class WorldLight { left_out, drawn };
Result<Style> load_style(const View& view, const HeightField& field, WorldLight light = WorldLight::left_out);

// What of a style follows from the view, after the eye has moved. Of one that moves on, what is shown stays
// as long as it may (steady_interval_m). Errors: posts that cannot be read.
enum class Eye { rests, moves };
Result<void> fit_to_view(Style& style, const View& view, const HeightField& field, Eye eye = Eye::rests);

}  // namespace oro
