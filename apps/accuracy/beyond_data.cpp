#include "apps/accuracy/beyond_data.h"

#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/eye/standpoint.h"
#include "apps/options/view_limits.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/view/overview.h"
#include "apps/view/truth.h"
#include "core/base/parallel.h"
#include "geo/sources/hgt_source.h"

namespace oro {
namespace {

constexpr std::size_t most_names = 12;

KnownGround known_ground(const View& view, const RegionGrid& grid) {
    std::vector<DegreeCell> missing;
    for (const std::string& name : grid.missing_cells) {
        if (const auto box = parse_tile_range(name); box.ok())
            missing.push_back(degree_cell_at(box->south_deg + 0.5, box->west_deg + 0.5));
    }
    std::optional<DegreeBox> part;
    if (const auto& box = view.region.box)
        part = DegreeBox{box->west_deg, box->south_deg, box->east_deg, box->north_deg};
    return KnownGround(grid.field, missing, grid.outside > 0, part);
}

std::string name_of(const DegreeCell& cell) {
    return tile_name(cell.lat_deg, cell.lon_deg);
}

std::string names(const UnseenGround& unseen) {
    std::string text;
    for (std::size_t i = 0; i < std::min(most_names, unseen.missing.size()); ++i)
        text += (text.empty() ? "" : ", ") + name_of(unseen.missing[i].cell);
    if (unseen.missing.size() > most_names)
        text += " and " + grouped(unseen.missing.size() - most_names) + " more";
    return "(missing: " + text + ")";
}

std::string columns(const UnseenGround& unseen, int beyond) {
    return grouped(static_cast<std::uint64_t>(beyond)) + " of " +
           counted(static_cast<std::uint64_t>(unseen.columns), "column", "columns");
}

nlohmann::ordered_json names_json(const std::vector<UnseenCell>& cells) {
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const UnseenCell& cell : cells) names.push_back(name_of(cell.cell));
    return names;
}

// Whole numbers, away from 0.
std::string whole(double value) {
    return (value < 0.0 ? "-" : "") + grouped(static_cast<std::uint64_t>(std::ceil(std::abs(value))));
}

}  // namespace

Result<double> unseen_ceiling(const std::optional<double>& option_m) {
    const double ceiling_m = option_m.value_or(usual_unseen_ceiling_m);
    constexpr Limits limits = view_limits::unseen_ceiling_m;
    if (limits.hold(ceiling_m)) return ceiling_m;
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", ceiling_m);
    return refused("--unseen-ceiling", text, between_words(limits.low, limits.high));
}

Result<UnseenGround> unseen_in(const View& view, const Region& region, double ceiling_m,
                               const TrueScene* truth) {
    const Geodetic& eye = view.camera.eye;
    const RegionGrid& grid = widest_at(region, eye.lat_deg, eye.lon_deg);
    std::optional<HeightField> lifted;
    std::optional<TrueSurface> made;
    if (!truth || region.grids.size() > 1) {
        if (!grid.geoid_left_out.N_m.empty()) {
            lifted = grid.field;
            lifted->undulation = grid.geoid_left_out;
            lifted->N_of_posts_m = grid.N_of_posts_left_out_m;
        }
        made.emplace(lifted ? *lifted : grid.field, view.exaggeration, thread_count());
    }
    const TrueSurface& surface = made ? *made : truth->ground().surface(0);
    const Camera camera = true_camera(view, region);
    UnseenGround unseen =
        unseen_ground(unseen_picture(surface, known_ground(view, grid), true_sight(view, region), camera,
                                     ceiling_m, thread_count()),
                      camera, ceiling_m);
    unseen.all_in_view = is_whole_in_view(view, region);
    ORO_CHECK(region.health());
    return unseen;
}

std::string unseen_sentence(const UnseenGround& unseen) {
    if (unseen.columns_beyond == 0 || unseen.all_in_view) return {};
    return "the view reaches past the data in " + columns(unseen, unseen.columns_beyond) + " " +
           names(unseen) + ": terrain there, if it is up to " + whole(unseen.ceiling_m) +
           " m high, could rise up to " + whole(unseen.bound_px) + " px above what is drawn";
}

std::string unseen_note(const UnseenGround& unseen) {
    if (unseen.columns_beyond == 0 || unseen.all_in_view) return {};
    return "the view reaches past the data in " + columns(unseen, unseen.columns_beyond) + " " +
           names(unseen) + ": ground up to " + whole(unseen.ceiling_m) + " m high there could rise up to " +
           whole(unseen.bound_px) +
           " px above what is drawn; give these tiles, too, or --fetch skadi gets them";
}

std::string unseen_ending(const UnseenGround& unseen) {
    if (unseen.columns_beyond == 0 || unseen.all_in_view) return {};
    return "In " + columns(unseen, unseen.columns_beyond) + " ground beyond the data could be up to " +
           whole(unseen.bound_px) + " px higher " + names(unseen) + ".";
}

std::string beyond_part_ending(const UnseenGround& unseen) {
    if (unseen.columns_beyond_part == 0 || unseen.all_in_view) return {};
    return "The part of the data that you chose ends here: in " +
           columns(unseen, unseen.columns_beyond_part) + " ground beyond it could be up to " +
           whole(unseen.part_bound_px) + " px higher.";
}

nlohmann::ordered_json unseen_json(const UnseenGround& unseen) {
    nlohmann::ordered_json part = json_object("columns_beyond", unseen.columns_beyond_part, "bound_px",
                                              unseen.part_bound_px, "cells", names_json(unseen.beyond_part));
    return json_object("kind", "unseen", "ceiling_m", unseen.ceiling_m, "columns", unseen.columns,
                       "columns_beyond", unseen.columns_beyond, "bound_px", unseen.bound_px, "missing",
                       names_json(unseen.missing), "chosen_part_ends", std::move(part), "all_data_in_view",
                       unseen.all_in_view);
}

}  // namespace oro
