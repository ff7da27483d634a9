// What a viewshed is asked, from its options.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/viewshed_report.h"
#include "apps/options/options.h"

namespace oro {

// How observers came to stand where they do.
struct Standpoints {
    std::vector<MovedToSummit> moved;  // of each of them, where they were asked to stand on summits
    std::vector<std::pair<std::string, MovedToSummit>> walls;  // before those that were not, by their --at
};

// Errors (usage): a place that is none, a radius or a height of targets beyond what there can be.
Result<void> check_viewshed(const ViewshedOptions& options);
// Errors (usage): targets on a canopy where none was asked for.
Result<void> check_target_on(const ViewshedOptions& options);

// All of a question but its eyes, which need the ground. Errors (usage): an air that is none.
Result<void> begin_question(const ViewshedOptions& options, ViewshedQuestion& question);
// Where the eyes of the options are asked to stand.
std::vector<Standing> asked_eyes(const ViewshedOptions& options);
// Places the eyes of a question, and what its targets stand on: the ground, or the canopy on it. Errors:
// those of stand_over_ground(); an eye in the canopy, which sees nothing (usage).
Result<void> place_eyes(const std::vector<Standing>& eyes, bool targets_on_canopy, const SightGround& ground,
                        ViewshedQuestion& question, Standpoints& standpoints);

// What the file of a viewshed says of the canopy, and of what targets stand on: "ground", "canopy". Nothing
// where nothing grows.
void add_canopy_tags(const SightGround& ground, const std::string& targets_stand_on, PostRaster& raster);

}  // namespace oro
