// What of a view its user changes while a window shows it. All of it stands in the view, so that a picture of
// it is drawn again to the byte.
#pragma once

#include <string>
#include <vector>

#include "apps/window/viewer.h"

namespace oro {

// Each changes the view, what is made of it, and asks for a picture. What is wrong with what was chosen is
// told and changes nothing. Errors: the device, posts that cannot be read.
Result<void> choose_style(Viewer& viewer, const std::string& style);
// One of the frame's own looks; nothing: the ground.
Result<void> choose_show(Viewer& viewer, std::optional<Show> show);
// A sun by time ("2026-06-21T05:30+02:00"); "": as if nobody asked for one.
Result<void> choose_sun(Viewer& viewer, const std::string& time);
// The view's own shadows and openness of the sky; nothing: as the style has it.
Result<void> choose_light(Viewer& viewer, std::optional<bool> shadows, std::optional<bool> sky_openness);
// The graticule over the ground; nothing: none.
Result<void> choose_graticule(Viewer& viewer, std::optional<Graticule> graticule);
// How high heights are drawn, 1: as they are. The levels are measured anew, and the picture is coarse
// meanwhile where that takes long.
Result<void> choose_exaggeration(Viewer& viewer, double factor);
// Which of the files that are loaded are shown: names and lines. False where they cannot be.
Result<bool> choose_vectors(Viewer& viewer, const VectorChoices& choices);
// Which images lie over the ground, and how opaque they are.
Result<void> choose_drape(Viewer& viewer, const std::vector<std::string>& files, double opacity);
// Which files of land cover colour the ground, the last on top, by the table that was chosen or that knows
// their codes. What cannot be read is said, and what is shown stays.
Result<void> choose_cover(Viewer& viewer, const std::vector<std::string>& files);

// Another scene of the first view, as it asks for now: coarse at first where measuring levels takes long.
// Errors: those of open_scene().
Result<void> renew_scene(Viewer& viewer);
// A renderer that smooths edges and explains frames as the view asks for now.
Result<void> renew_renderer(Viewer& viewer);

}  // namespace oro
