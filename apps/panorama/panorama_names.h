// The names of a panorama: a row of upright text above the scene, and a line from each down to its summit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/names/seen_points.h"
#include "apps/panorama/sheet.h"
#include "apps/text/text_face.h"

namespace oro {

// The row that names stand in.
struct SlotRow {
    double low_px{};       // no slot is left of this
    double high_px{};      // or right of this
    double apart_px{};     // the least distance between two slots
    double farthest_px{};  // the most that a slot may be from its place
};

// A slot for each place, or none where there is no room. `places_px` come by rank: who comes first has a slot
// for certain if any can have one. Slots stand in the order of their places, so that lines from one to the
// other do not cross; of all such slots they are those whose squared distances from their places have the
// least sum.
std::vector<std::optional<double>> name_slots(const std::vector<double>& places_px, const SlotRow& row);

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
