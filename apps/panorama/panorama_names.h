// The names of a panorama: a row of upright text above the scene, and a line from each down to its summit.
#pragma once

#include <string>
#include <vector>

#include "apps/names/seen_points.h"
#include "apps/panorama/sheet.h"
#include "apps/text/text_face.h"

namespace oro {

struct PanoramaName {
    SeenPoint point;      // place_px: from the scene's top left corner
    std::string heights;  // "4274 m  23 km", after the name
    double slot_px{};     // column in which the name stands, in its middle
    double name_px{};     // lengths of the texts
    double heights_px{};
    double azimuth_deg{};  // where the line stands
    double elevation_deg{};
};

struct PanoramaNames {
    std::vector<PanoramaName> named;  // the highest rank first
    std::vector<std::string> without_room;
    int without_letters{};
    PointCounts counts;
    double em_px{};
    double row_px{};  // height of the row, 0 without names

    // Columns and lines of the row and below it, for a sheet whose scene begins below the row.
    void put_on(Sheet& sheet) const;
};

// A name that is longer than so many times the letters' size, with its height, has no room.
inline constexpr double longest_name_ems = 36.0;

// `in_view` is of the same cylinder. Errors: those of text.
Result<PanoramaNames> panorama_names(const std::vector<NamedPoint>& points, const PointsInView& in_view,
                                     const Cylinder& around, const TextFace& face, double em_px);

// The name of the point that an eye stands at: the nearest one within 150 m across its vertical; "" where
// there is none whose letters the font has. Errors: those of text.
Result<std::string> standpoint_name(const std::vector<NamedPoint>& points, const Geodetic& eye,
                                    const TextFace& face);

}  // namespace oro
