#include "apps/legend/colour_key.h"

#include <algorithm>
#include <cmath>

#include "apps/legend/legend.h"
#include "core/base/srgb.h"
#include "core/drape/materials.h"
#include "core/frame/frame_colours.h"
#include "core/terrain/level_grid.h"
#include "geo/together/mesh_detail.h"

namespace oro {
namespace {

std::uint8_t code_of(double value) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

double snow_line_m(const gpu::GroundCover& cover, double lat_deg) {
    for (std::uint32_t i = 1; i < cover.snow_line_count; ++i) {
        const gpu::SnowLineStop &south = cover.snow_line[i - 1], &north = cover.snow_line[i];
        const double from = static_cast<double>(south.lat_deg), to = static_cast<double>(north.lat_deg);
        if (lat_deg > to && i + 1 < cover.snow_line_count) continue;
        const double share = std::clamp((lat_deg - from) / (to - from), 0.0, 1.0);
        return (1.0 - share) * static_cast<double>(south.H_m) + share * static_cast<double>(north.H_m);
    }
    return 0.0;
}

StripColour coded(const gpu::vec3& colour) {
    return {code_of(static_cast<double>(colour.x)), code_of(static_cast<double>(colour.y)),
            code_of(static_cast<double>(colour.z))};
}

// What a picture shows of how meshes are drawn.
ColourKey key_of_mesh_parts(Show show, std::size_t levels) {
    ColourKey key;
    key.shape = KeyShape::names;
    if (show == Show::levels) {
        key.title = "Levels of the meshes' cluster graphs: 0 has every triangle";
        for (std::size_t level = 0; level < levels; ++level)
            key.names.push_back(
                {coded(colour_of_level(static_cast<gpu::uint>(level))), std::to_string(level)});
        return key;
    }
    key.title = std::string("Each ") + (show == Show::groups ? "group of clusters" : "cluster") +
                " of meshes in a colour of its own";
    for (gpu::uint i = 0; i < 6; ++i) key.names.push_back({coded(colour_of_number(i)), ""});
    return key;
}

// What a picture shows of its own making.
ColourKey key_of_show(Show show, bool clusters, const Region& region, int every) {
    ColourKey key;
    key.shape = KeyShape::names;
    if (show == Show::levels && clusters) {
        key.title = "Levels of the cluster graph: 0 has every triangle";
        const std::size_t levels = 1 + region.grids.front().clusters->outline().levels.size();
        for (std::size_t level = 0; level < levels; ++level)
            key.names.push_back(
                {coded(colour_of_level(static_cast<gpu::uint>(level))), std::to_string(level)});
    } else if (show == Show::visible) {
        key.title = "Drawn by";
        key.names = {{coded(colour_of_round(true)), "a round before the last"},
                     {coded(colour_of_round(false)), "the last: what those left open"}};
    } else if (show == Show::levels) {
        key.title = "Levels: one post of so many, along rows and columns";
        int levels = 1;
        for (const RegionGrid& grid : region.grids) levels = std::max(levels, level_count(grid.field.grid));
        for (int level = 0; level < levels; ++level)
            key.names.push_back({coded(colour_of_level(static_cast<gpu::uint>(level))),
                                 std::to_string(static_cast<std::int64_t>(every) << level)});
    } else if (show == Show::overdraw) {
        key.title = "Triangles that cover a pixel, hidden ones too";
        for (const auto& [triangles, name] :
             {std::pair{1U, "1"}, {2U, "2"}, {4U, "3-4"}, {8U, "5-8"}, {16U, "9-16"}, {17U, "more"}})
            key.names.push_back({coded(colour_of_overdraw(triangles)), name});
    } else {
        const char* const what = show == Show::groups      ? "group of clusters"
                                 : show == Show::triangles ? "triangle"
                                 : clusters                ? "cluster"
                                                           : "meshlet";
        key.title = "Each " + std::string(what) + " in a colour of its own";
        for (gpu::uint i = 0; i < 6; ++i) key.names.push_back({coded(colour_of_number(i)), ""});
    }
    return key;
}

// Of what a rule may make of ground, the mean colours.
ColourKey key_of_materials(const gpu::MaterialTable& materials) {
    ColourKey key;
    key.shape = KeyShape::names;
    key.title = "Ground, by a rule";
    for (std::size_t i = 0; i <= gpu::material_snow; ++i) {
        StripColour colour{};
        for (int c = 0; c < 3; ++c)
            colour[static_cast<std::size_t>(c)] =
                code_of(srgb_of_light(static_cast<double>(materials.of[i].colour[c])));
        key.names.push_back({colour, material_names[i]});
    }
    return key;
}

// Classes of one colour cannot be told apart in a picture: they share a square, while there is room for their
// names.
void add_class(ColourKey& key, const CoverClass& one) {
    constexpr std::size_t longest_name = 60;  // bytes: a legend 320 px wide has room for so many
    const StripColour colour{one.colour[0], one.colour[1], one.colour[2]};
    for (ColourKey::Named& named : key.names) {
        const std::string both = named.name + " / " + one.name;
        if (named.colour != colour || both.size() > longest_name) continue;
        named.name = both;
        return;
    }
    key.names.push_back({colour, one.name});
}

// The classes that are shown, or where that is not known those that the files hold; then what a rule makes of
// ground of which no file knows.
ColourKey key_of_cover(const CoverMap& cover, const gpu::MaterialTable& materials, const ShownGround* shown) {
    ColourKey key;
    key.shape = KeyShape::names;
    const auto has = [&](int code) {
        if (shown) return shown->codes.contains(code);
        return std::ranges::any_of(cover.sources(),
                                   [&](const CoverSource& source) { return source.codes.contains(code); });
    };
    for (const CoverClass& one : cover.table().classes)
        if (std::ranges::any_of(one.codes, has)) add_class(key, one);
    if (shown && !shown->by_rule) {
        key.title = "Land cover";
        return key.names.empty() ? ColourKey{} : key;
    }
    const ColourKey rule = materials.on != 0 ? key_of_materials(materials) : ColourKey{};
    if (shown && key.names.empty() && !rule.names.empty()) return rule;
    key.title = rule.names.empty() ? "Land cover; where none is known, by a rule"
                                   : "Land cover; then, where none is known, ground by a rule";
    key.names.insert(key.names.end(), rule.names.begin(), rule.names.end());
    return key;
}

// Nothing but images has its colours in the picture.
ColourKey key_of_images() {
    ColourKey key;
    key.shape = KeyShape::names;
    key.title = "The ground has the colours of an image";
    return key;
}

// Whether colours along a bar can be told apart: those of contours are paper.
bool has_different_colours(const ColourKey& key) {
    constexpr int steps = 64, least_difference = 24;  // of 255
    StripColour lowest{255, 255, 255}, highest{0, 0, 0};
    for (int i = 0; i <= steps; ++i) {
        const StripColour colour = key.colour(key.low + (key.high - key.low) * i / steps);
        for (std::size_t c = 0; c < colour.size(); ++c) {
            lowest[c] = std::min(lowest[c], colour[c]);
            highest[c] = std::max(highest[c], colour[c]);
            if (highest[c] - lowest[c] >= least_difference) return true;
        }
    }
    return false;
}

void add_ticks(ColourKey& key, double step) {
    for (double at = std::ceil(key.low / step) * step; at <= key.high; at += step) key.ticks.push_back(at);
}

}  // namespace

StripColour ColourKey::colour(double value) const {
    std::size_t next = 0;
    while (next < stops.size() && static_cast<double>(stops[next].at) < value) ++next;
    const gpu::TintStop& after = stops[std::min(next, stops.size() - 1)];
    const gpu::TintStop& before = stops[next == 0 ? 0 : next - 1];
    const double from = static_cast<double>(before.at), to = static_cast<double>(after.at);
    const double share = to > from ? std::clamp((value - from) / (to - from), 0.0, 1.0) : 0.0;
    StripColour mixed{};
    for (int c = 0; c < 3; ++c) {
        const double light = (1.0 - share) * static_cast<double>(before.colour[c]) +
                             share * static_cast<double>(after.colour[c]);
        mixed[static_cast<std::size_t>(c)] = code_of(codes ? light : srgb_of_light(light));
    }
    return mixed;
}

ColourKey colour_key(const View& view, const Region& region, const Style& style, int every,
                     const ShownGround* shown) {
    if (view.shows_mesh_parts) return key_of_mesh_parts(*view.show, mesh_levels(region));
    if (view.show) return key_of_show(*view.show, view.mesh == "clusters", region, every);
    if (shown && shown->under_images) return key_of_images();
    const gpu::FrameStyle& frame = style.frame;
    if (view.cover && frame.colour_by == gpu::colour_by_cover)
        return key_of_cover(*view.cover, frame.materials, shown);
    if (frame.materials.on != 0) return key_of_materials(frame.materials);
    ColourKey key;
    key.stops.assign(frame.tints, frame.tints + frame.tint_count);
    key.codes = frame.tints_as_codes != 0;
    if (key.stops.size() < 2) return key;
    key.shape = KeyShape::bar;
    key.unit = "°";
    if (frame.colour_by == gpu::colour_by_aspect) {
        key.shape = KeyShape::wheel;
        key.title = "Slopes face";
        return key;
    }
    if (frame.colour_by == gpu::colour_by_slope) {
        key.title = "Slope of the ground";
        key.high = 75.0;
        add_ticks(key, 15.0);
        return key;
    }
    key.unit = " m";
    key.title = "Height above sea level";
    if (frame.colour_by == gpu::colour_by_cover) {
        key.title = "Level ground by height above sea level";
        const double snow_m = snow_line_m(frame.cover, view.camera.eye.lat_deg);
        for (gpu::TintStop& stop : key.stops) stop.at += static_cast<float>(snow_m);
    }
    const HeightRange range = height_range(region.grids.front().field);
    key.low = static_cast<double>(range.lowest_m);
    key.high = std::max(key.low + 1.0, static_cast<double>(range.highest_m));
    if (!has_different_colours(key)) return {};
    add_ticks(key, round_length(std::max(1.0, (key.high - key.low) / 2.5)));
    return key;
}

}  // namespace oro
