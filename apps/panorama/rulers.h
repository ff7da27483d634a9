// The rulers of a panorama: azimuths below the scene, elevations at both its sides, the level line.
#pragma once

#include <string>

#include "apps/panorama/sheet.h"
#include "apps/text/text_face.h"
#include "core/earth/cylinder.h"

namespace oro {

struct Rulers {
    double azimuth_step_deg{};  // from figure to figure
    double azimuth_tick_deg{};  // from tick to tick
    double elevation_step_deg{};
    double elevation_tick_deg{};
    double em_px{};

    // Height of the strip below the scene.
    [[nodiscard]] int strip_px() const;
};

// Steps that leave room for their figures.
Rulers rulers_of(const Cylinder& around, double em_px);

// Puts them on a sheet that has its size and its scene's place. What is told below: the eye on the left,
// whose data they are on the right, as far as there is room. Errors: those of text.
Result<void> put_rulers(const Rulers& rulers, const Cylinder& around, const TextFace& face,
                        const std::string& left_text, const std::string& right_text, Sheet& sheet);

}  // namespace oro
