// A panorama from a place that a window's user has picked, by the code of the command panorama.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/commands/panorama/panorama_drawing.h"
#include "geo/places/geodesic.h"

namespace oro {

// What its user chooses.
struct PanoramaChoice {
    LatLon place;
    double above_m{2.0};  // the eye over the ground
    int width_px{3600};
    bool bends{true};  // light bends as in standard air where the view's goes straight
};

// The view of the panorama: the one that is shown, with its eye at the place. Its frame is still to be found.
// Errors: no ground to stand on (no_data).
Result<View> panorama_view(const View& shown, const PanoramaChoice& choice, const Region& region);

struct DrawnPanorama {
    View view;
    Style style;
    PanoramaSheet laid;
    CylinderPicture scene;
    bool leaves_out_near{};         // ground close to the eye stands higher than is shown
    std::vector<std::uint8_t> rgb;  // the sheet's rows
};

// Draws the panorama of a view all around, on a device of its own. From any thread; the region and its cuts
// stay as they are meanwhile. Errors: those of set_frame(), lay_out() and draw_panorama().
Result<DrawnPanorama> drawn_panorama(View view, const AskedFrame& asked, const Region& region,
                                     const RegionCuts& cuts, const PanoramaDrawing& drawing,
                                     const Progress& progress);
// Writes it as the command does, by the file's ending (.png, .jpg, .tif, .svg). Errors: those of the file.
Result<void> write_drawn_panorama(const std::string& path, const DrawnPanorama& drawn, const Region& region);

// A part of a sheet in a window.
struct SheetPart {
    double left_px{}, top_px{};   // of the sheet, in the window's top left corner
    double scale{1.0};            // pixels of the window for one of the sheet
    int width_px{}, height_px{};  // of the window
    bool operator==(const SheetPart&) const = default;
};
// Its pixels, four bytes each, opaque. One of the window is the mean of those of the sheet that it covers, or
// dark beside the sheet. rgb: the sheet's rows.
std::vector<std::uint8_t> pixels_of(const SheetPart& part, const std::vector<std::uint8_t>& rgb,
                                    int sheet_width_px, int sheet_height_px);

}  // namespace oro
