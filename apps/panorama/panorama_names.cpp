#include "apps/panorama/panorama_names.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "apps/names/name_labels.h"

namespace oro {
namespace {

// All of the em.
constexpr double apart_share = 1.3;     // from name to name
constexpr double farthest_share = 4.0;  // of a name from its summit's column
constexpr double knee_share = 2.2;      // how high lines lean over to their names
constexpr double foot_share = 0.35;     // from a line to its name
constexpr double between_share = 0.7;   // from a name to its height
constexpr double top_share = 0.9;       // above the longest name
constexpr double line_share = 0.06;
constexpr double off_summit_share = 0.25;  // from a summit to its line
constexpr double heights_size = 0.86;
constexpr SheetColour name_ink_colour{24, 30, 42}, heights_ink{92, 98, 110}, line_ink{70, 78, 94},
    line_halo{214, 226, 238};

}  // namespace

Result<PanoramaNames> panorama_names(const std::vector<NamedPoint>& points, const PointsInView& in_view,
                                     const Cylinder& around, const TextFace& face, double em_px) {
    PanoramaNames names;
    names.em_px = em_px;
    std::vector<PanoramaName> written;
    std::vector<double> places_px;
    for (SeenPoint& point : in_view.seen(points, names.counts)) {
        ORO_TRY(const bool has_all, face.has_all(point.name));
        if (!has_all) {
            ++names.without_letters;
            continue;
        }
        PanoramaName name;
        name.heights = heights_words(point.H_m, point.distance_m);
        ORO_TRY(name.name_px, face.width_px(point.name, em_px));
        ORO_TRY(name.heights_px, face.width_px(name.heights, heights_size * em_px));
        if (name.name_px + between_share * em_px + name.heights_px > longest_name_ems * em_px) {
            names.without_room.push_back(point.name);
            continue;
        }
        name.azimuth_deg = around.azimuth_deg_at(point.place_px.x);
        name.elevation_deg = around.elevation_deg_at(point.place_px.y);
        name.point = std::move(point);
        places_px.push_back(name.point.place_px.x);
        written.push_back(std::move(name));
    }
    const double border_px = 0.8 * em_px;
    const std::vector<std::optional<double>> slots = name_slots(
        places_px, {border_px, around.width_px - border_px, apart_share * em_px, farthest_share * em_px});
    double longest_px = 0.0;
    for (std::size_t i = 0; i < written.size(); ++i) {
        if (!slots[i]) {
            names.without_room.push_back(written[i].point.name);
            continue;
        }
        written[i].slot_px = *slots[i];
        longest_px = std::max(longest_px, written[i].name_px + between_share * em_px + written[i].heights_px);
        names.named.push_back(std::move(written[i]));
    }
    if (!names.named.empty()) names.row_px = longest_px + (knee_share + foot_share + top_share) * em_px;
    return names;
}

Result<std::string> standpoint_name(const std::vector<NamedPoint>& points, const Geodetic& eye,
                                    const TextFace& face) {
    constexpr double at_it_m = 150.0;
    std::string nearest;
    double nearest_m = at_it_m;
    for (const NamedPoint& point : points) {
        const double away_m = glm::length(ecef_from_geodetic({point.lat_deg, point.lon_deg, eye.h_m}).m -
                                          ecef_from_geodetic(eye).m);
        if (away_m >= nearest_m) continue;
        ORO_TRY(const bool has_all, face.has_all(point.name));
        if (!has_all) continue;
        nearest = point.name;
        nearest_m = away_m;
    }
    return nearest;
}

void PanoramaNames::put_on(Sheet& sheet) const {
    const double bottom_px = sheet.scene_top_px, knee_px = bottom_px - knee_share * em_px,
                 foot_px = knee_px - foot_share * em_px;
    for (const PanoramaName& name : named) {
        const double x = name.point.place_px.x, width_px = std::max(1.0, line_share * em_px);
        const double summit_px = bottom_px + name.point.place_px.y - off_summit_share * em_px;
        // Light beside it: it is read on a dark sky, too.
        for (const auto& [wide_px, colour] : {std::pair{width_px + 1.2, line_halo}, {width_px, line_ink}})
            sheet.lines.push_back({{x, std::max(bottom_px, summit_px)}, {x, bottom_px}, wide_px, colour});
        sheet.lines.push_back({{x, bottom_px}, {name.slot_px, knee_px}, width_px, line_ink});
        SheetText text;
        text.anchor = SheetText::Anchor::begin;
        text.angle_deg = -90.0;
        text.text = name.point.name;
        text.at_px = {name.slot_px, foot_px};
        text.size_px = em_px;
        text.length_px = name.name_px;
        text.ink = name_ink_colour;
        text.kind = "name";
        sheet.texts.push_back(text);
        text.text = name.heights;
        text.at_px.y -= name.name_px + between_share * em_px;
        text.size_px = heights_size * em_px;
        text.length_px = name.heights_px;
        text.ink = heights_ink;
        text.kind = "heights";
        sheet.texts.push_back(std::move(text));
    }
}

}  // namespace oro
