// What is said of a picture whose view trees near its eye hide.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/earth/camera.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// The share of a picture's pixels that show a tree near its eye.
double near_trees_share(const PictureReport& report, const Camera& camera);

// "trees within 100 m of the eye hide 93 % of the picture; --trees off shows the ground, and so does a
// greater --above"; "" where they are in less than half of it. share: of its pixels.
std::string near_trees_note(double share);

// Fields within_m and share, and the note where there is one.
nlohmann::ordered_json near_trees_json(double share);

}  // namespace oro
