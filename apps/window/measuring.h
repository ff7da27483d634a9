// The line that a window's user measures: one that is drawn, or one of a file.
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Adds what is seen at a point of the picture. Nothing where there is no ground. Errors: posts.
Result<void> add_place(Viewer& viewer, glm::dvec2 point_px);
Result<void> take_back_place(Viewer& viewer);
// Measures a line of places anew, in the place of that which is there. Errors: likewise.
Result<void> measure_places(Viewer& viewer, const std::vector<LatLon>& places);
Result<void> clear_places(Viewer& viewer);

// A line of a file over the ground or of names.
struct LoadedLine {
    std::string file;
    int number{};  // in it, from 1
    std::string name;
};
[[nodiscard]] bool has_loaded_lines(const View& view);
std::vector<LoadedLine> loaded_lines(const View& view);
// Measures one in the place of what is drawn. Errors: posts; what is wrong with the file is said.
Result<void> measure_loaded(Viewer& viewer, const LoadedLine& line);

// Writes the profile into the working folder, as `orograph profile` does: ending is ".csv", ".svg" or
// ".geojson". What is wrong with the file is said.
Result<void> save_profile(Viewer& viewer, const std::string& ending);

}  // namespace oro
