// A map of what a window shows: of the places that are seen, from straight above.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/view/view.h"
#include "geo/places/bounding_box.h"

namespace oro {

struct Viewer;

// What is asked for in the panel of pictures.
struct MapChoice {
    std::string box;        // W,S,E,N in degrees, as --bbox takes it
    double resolution_m{};  // a side of a pixel; 0: about as far as the posts of the data
    bool contours{false};   // contour lines in place of the view's style
    std::string ending{".tif"};
};

// A box of some places, each as latitude and longitude in degrees and its distance in metres: of those that
// are at most three times as far as half of all are, so that a far horizon does not make it a map of a
// country. It goes over the 180th meridian where the places do. Nothing of no places.
struct SeenFromEye {
    double lat_deg{}, lon_deg{}, distance_m{};
};
std::optional<BoundingBox> box_of_places(std::vector<SeenFromEye> places);

// The words of the command that draws the map of a view's data and light: {"shot", "N46E008.hgt", ...}. What
// maps do not take (names, lines, canopy) is left out.
std::vector<std::string> map_words(const View& view, const MapChoice& choice, const std::string& out);

// What is proposed for what is shown now. Errors: damage in a baked region.
Result<MapChoice> proposed_map(Viewer& viewer);
// The same, for the panel.
Result<void> propose_map(Viewer& viewer);
// Begins to draw it, beside the window, into the working folder. What goes wrong is told.
void draw_map(Viewer& viewer, const MapChoice& choice);

}  // namespace oro
