#include "apps/view/style.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/report/json_fields.h"
#include "apps/styles/colour_table.h"
#include "apps/styles/contour_interval.h"
#include "apps/styles/data_folder.h"
#include "apps/styles/style_json.h"
#include "apps/view/model_names.h"
#include "apps/view/trees_of_view.h"
#include "core/light/sun_position.h"
#include "core/made_pages/made_pages.h"
#include "geo/files/text_encoding.h"
#include "shaders/shared_growth.h"

namespace oro {
namespace {

bool is_table(const std::string& style) {
    return style.ends_with(".txt");
}

Result<Style> read_style(const std::string& text, const std::string& path, const HeightField& field) {
    if (is_table(path)) {
        Style style{};
        ORO_TRY(style.frame, style_of_colour_table(text, path, [&] { return height_range(field); }));
        ORO_CHECK(field.health());
        style.sun = {0.0, 90.0};
        return style;
    }
    return style_of_text(text, path);
}

// That the style draws what options ask for. What only a view's file says may have no effect.
Result<void> check_surroundings(const View& view, const gpu::FrameStyle& style) {
    const auto of_no_use = [&](const std::string& option, const std::string& what) {
        return Error{ErrorKind::usage, option,
                     "is for styles with " + what + "; " + view.style + " has none"};
    };
    if (view.sea_asked && view.sea != Sea::level && style.water.on == 0)
        return of_no_use(std::string("--sea ") + name_in(sea_names, view.sea), "water");
    const bool has_skirt = (style.voids.on & gpu::voids_with_skirt) != 0;
    if (view.rim_asked && view.rim == Rim::none && !has_skirt) return of_no_use("--rim none", "voids");
    return {};
}

// What the view says of the sea and of the rim. No dry land lies as low as 500 m below the sea: a region that
// has such ground tells the sea's depth, and all of it that is not above 0 is sea.
Result<void> surround(gpu::FrameStyle& style, const View& view, const HeightField& field) {
    if (view.rim == Rim::none) style.voids.on &= ~gpu::voids_with_skirt;
    gpu::WaterModel& water = style.water;
    if (water.on == 0) return {};
    // Posts are not below -12,000 m. Below -100,000 m ground would be coloured by the sea's depth (land_H_m
    // in shaders/shade/water.glsl), and --sea low tells none.
    constexpr float lowest_land_H_m = -500.0F, below_all_H_m = -2e4F, noise_m = 5.0F;
    if (view.sea == Sea::voids) water.voids_are_sea = 1;
    if (view.sea == Sea::low) {
        water.sea_low_H_m = below_all_H_m;
        water.sea_high_H_m = noise_m;
    }
    if (height_range(field).lowest_m < lowest_land_H_m) {
        water.sea_low_H_m = -1e9F;
        water.sea_high_H_m = std::max(water.sea_high_H_m, 0.0F);
    }
    return field.health();
}

// What the view says of labels.
Result<void> label_by(const View& view, Style& style) {
    constexpr double usual_px = 11.0;
    const bool has_lines = style.contours_by_view || style.frame.contours.interval_m > 0.0F;
    if (view.labels.value_or(false) && !has_lines)
        return Error{ErrorKind::usage, "--labels on",
                     "the style '" + view.style + "' has no contour lines that could be labelled"};
    if (!view.labels) return {};
    if (!*view.labels)
        style.labels_px = 0.0;
    else if (style.labels_px == 0.0)
        style.labels_px = usual_px;
    return {};
}

// What the view says of trees. A style of materials that has none by itself may have them, too. A canopy has
// the ground's own trees in it, and an image shows them: invented ones would stand on top.
Result<void> plant_by(const View& view, gpu::FrameStyle& style) {
    if (!view.trees) {
        if (stands_for_trees(view) != nullptr) style.materials.on &= ~gpu::materials_with_trees;
        return {};
    }
    if (*view.trees && style.materials.on == 0)
        return Error{ErrorKind::usage, "--trees on",
                     "the style '" + view.style + "' knows no ground that trees could stand on"};
    if (*view.trees)
        style.materials.on |= gpu::materials_with_trees;
    else
        style.materials.on &= ~gpu::materials_with_trees;
    return {};
}

// What the view says of how far apart contour lines stand.
Result<void> space_contours_by(const View& view, Style& style) {
    if (!view.contour_interval_m) return {};
    if (!style.contours_by_view && !(style.frame.contours.interval_m > 0.0F))
        return Error{ErrorKind::usage, "--contour-interval",
                     "the style '" + view.style + "' has no contour lines; contours has"};
    style.contours_by_view = false;
    style.frame.contours.interval_m = static_cast<float>(*view.contour_interval_m);
    return {};
}

}  // namespace

std::vector<std::string> style_names() {
    std::vector<std::string> names;
    std::error_code failed;
    std::filesystem::directory_iterator entry(data_folder() / "styles", failed);
    for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
        if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
    }
    std::ranges::sort(names, {}, [](const std::string& name) { return std::pair(name != "natural", name); });
    return names;
}

bool is_style_path(const std::string& style) {
    return style.ends_with(".json") || is_table(style) || style.find('/') != std::string::npos;
}

std::string present_name(const std::string& style) {
    return style == "default" ? "haze" : style;
}

void light_by(const SunDirection& sun, gpu::FrameStyle& style) {
    style.sun_enu = gpu::vec3(enu_towards(sun.azimuth_deg, sun.elevation_deg));
    style.sun_hidden = static_cast<float>(1.0 - direct_light(sun));
    // Wind has the clock's time of the day; where nobody asked for one, the air is still.
    constexpr std::int64_t day_s = 86400;
    style.materials.wind = style.materials.wind_time_s = 0.0F;
    if (!sun.time || sun.is_usual) return;
    style.materials.wind = 1.0F;
    style.materials.wind_time_s = static_cast<float>((sun.time->utc_s % day_s + day_s) % day_s);
}

namespace {

std::string file_of_style(const std::string& name) {
    return is_style_path(name) ? name : (data_folder() / "styles" / (present_name(name) + ".json")).string();
}

}  // namespace

bool has_sun_by_place(View& view) {
    const std::string path = file_of_style(view.style);
    if (is_table(path)) return false;
    auto text = read_text_file(path);
    if (!text.ok()) return false;
    view.style_text = StyleText{path, std::move(*text)};
    const Result<Style> read = style_of_text(view.style_text->text, path);
    return read.ok() && read->sun_by_place;
}

// Whether an eye is so low that most of the ground around it is hidden, and not so near to a pole that it
// sees all meridians.
static bool shows_little_ground(const View& view, const HeightField& field) {
    constexpr double most_over_m = 1000.0, most_lat_deg = 75.0;
    const Geodetic& eye = view.camera.eye;
    return eye.h_m <= static_cast<double>(height_range(field).highest_m) + most_over_m &&
           std::abs(eye.lat_deg) <= most_lat_deg;
}

// Of a view that shows parts of meshes by their colours: the ground below them has one, and its light.
static View plainly(const View& view) {
    View plain = view;
    plain.shows_mesh_parts = false;
    plain.style = "plain";
    plain.visibility_km.reset(), plain.contour_interval_m.reset();
    plain.trees.reset(), plain.labels.reset();
    return plain;
}

Result<Style> load_style(const View& view, const HeightField& field, WorldLight light) {
    if (view.shows_mesh_parts) return load_style(plainly(view), field, light);
    const std::string& name = view.style;
    const bool is_path = is_style_path(name);
    const std::string path = file_of_style(name);
    const Result<std::string> text = view.style_text && view.style_text->path == path
                                         ? Result<std::string>(view.style_text->text)
                                         : read_text_file(path);
    if (!text.ok()) {
        const bool no_such = access(path.c_str(), F_OK) != 0 && (errno == ENOENT || errno == ENAMETOOLONG);
        if (!is_path && no_such) {
            if (const std::string names = joined(style_names(), ", "); !names.empty())
                return Error{ErrorKind::usage, "--style " + name,
                             "no style is called '" + name + "'; there is: " + names};
        }
        return Error{!is_path && no_such ? ErrorKind::usage : ErrorKind::failed, "--style " + name,
                     text.error().line()};
    }
    const auto plain = utf8_text(*text);
    if (!plain.ok()) return Error{ErrorKind::failed, path, plain.error().what};
    ORO_TRY(Style style, read_style(*plain, path, field));
    if (view.visibility_km) {
        if (style.frame.air.on == 0)
            return Error{ErrorKind::usage, "--visibility", "is for styles with air; " + name + " has none"};
        set_visibility(*view.visibility_km, style.frame.air);
    }
    style.sun = view.sun.value_or(style.sun);
    light_by(style.sun, style.frame);
    if (view.shadows.value_or(false) && style.frame.light != gpu::light_sun)
        return Error{ErrorKind::usage, "--shadows on",
                     "the style '" + name + "' has no sunlight that ground could keep off"};
    if (view.sky_openness.value_or(false) && style.frame.light != gpu::light_sun)
        return Error{ErrorKind::usage, "--sky-openness on",
                     "the style '" + name + "' has no light of the sky"};
    ORO_CHECK(plant_by(view, style.frame));
    ORO_CHECK(space_contours_by(view, style));
    ORO_CHECK(label_by(view, style));
    if (made_posts_of(field) != nullptr && !(light == WorldLight::drawn && shows_little_ground(view, field)))
        style.frame.shadows = style.frame.sky_openness = 0;
    if (view.shadows) style.frame.shadows = *view.shadows ? 1 : 0;
    if (view.sky_openness) style.frame.sky_openness = *view.sky_openness ? 1 : 0;
    if (view.show)
        style.frame.smooth_edges = 0;
    else if (view.edges)
        style.frame.smooth_edges = *view.edges == Edges::smooth ? 1 : 0;
    ORO_CHECK(check_surroundings(view, style.frame));
    ORO_CHECK(surround(style.frame, view, field));
    ORO_CHECK(fit_to_view(style, view, field));
    return style;
}

Result<void> fit_to_view(Style& style, const View& view, const HeightField& field, Eye eye) {
    if (!style.contours_by_view) return {};
    const double wanted_m = contour_interval_m(view.camera, view.exaggeration, field);
    const double shown_m = static_cast<double>(style.frame.contours.interval_m);
    style.frame.contours.interval_m =
        static_cast<float>(eye == Eye::moves ? steady_interval_m(shown_m, wanted_m) : wanted_m);
    return field.health();
}

gpu::uint shown_by(Show show) {
    switch (show) {
        case Show::visible:
            return gpu::show_visible;
        case Show::levels:
            return gpu::show_levels;
        case Show::meshlets:
            return gpu::show_meshlets;
        case Show::clusters:
            return gpu::show_clusters;
        case Show::groups:
            return gpu::show_groups;
        case Show::overdraw:
            return gpu::show_overdraw;
        case Show::triangles:
            break;
    }
    return gpu::show_triangles;
}

}  // namespace oro
