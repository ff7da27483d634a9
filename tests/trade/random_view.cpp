#include "tests/trade/random_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <variant>

#include "apps/view/view_option_table.h"
#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "tests/support/found_texts.h"

namespace oro::test {
namespace fs = std::filesystem;
namespace {

double unit(Random& random) {
    return std::uniform_real_distribution<double>(0.0, 1.0)(random);
}
double between(Random& random, double from, double to) {
    return from + (to - from) * unit(random);
}
bool chance(Random& random, double share) {
    return unit(random) < share;
}
template <class Value>
const Value& one_of(Random& random, const std::vector<Value>& values) {
    return values[random() % values.size()];
}
// A number that few digits tell.
double rounded(double value, double steps_per_one) {
    return std::round(value * steps_per_one) / steps_per_one;
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", value);
    return text;
}

// The south-west corner of a tile, from its name.
struct Corner {
    int lat;
    int lon;
    auto operator<=>(const Corner&) const = default;
};
std::optional<Corner> corner_of(const fs::path& file) {
    const auto names = found_texts(file.filename().string(), R"(^([NS])(\d\d)([EW])(\d\d\d)\..*hgt.*$)");
    if (names.empty()) return std::nullopt;
    const std::vector<std::string>& found = names.front();
    const int lat = std::stoi(found[2]), lon = std::stoi(found[4]);
    return Corner{found[1] == "N" ? lat : -lat, found[3] == "E" ? lon : -lon};
}

}  // namespace

RandomRegions::RandomRegions(const fs::path& data, std::uint64_t seed, bool whole_folders) : random_(seed) {
    std::map<fs::path, std::set<Corner>> corners;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(data)) {
        if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
        files_.push_back(entry.path());
        if (const auto corner = corner_of(entry.path())) corners[entry.path().parent_path()].insert(*corner);
    }
    std::sort(files_.begin(), files_.end());
    for (const fs::path& file : files_) {
        const auto corner = corner_of(file);
        if (!corner) continue;
        const std::set<Corner>& of_folder = corners[file.parent_path()];
        if (of_folder.contains({corner->lat, corner->lon + 1})) tiles_.push_back(file);
        // More than some dozens of tiles are opened in parts alone.
        if (whole_folders && of_folder.size() <= 20) folders_.push_back(file.parent_path());
    }
    std::shuffle(files_.begin(), files_.end(), random_);
    // Of the largest folder every third file: it is that of a scale case.
    std::erase_if(files_, [&](const fs::path& file) {
        return corners[file.parent_path()].size() > 20 && corner_of(file)->lon % 3 != 0;
    });
}

RegionOptions RandomRegions::next() {
    RegionOptions options;
    const double kind = unit(random_);
    if (taken_++ % 2 == 0 || tiles_.empty())
        options = file();
    else if (kind < 0.3)
        options = pair();
    else if (kind > 0.92 && !folders_.empty())
        options.paths = {one_of(random_, folders_).string()};
    else
        options = box();
    options.fill_voids = chance(random_, 0.15);
    return options;
}

RegionOptions RandomRegions::file() {
    RegionOptions options;
    options.paths = {files_[files_taken_++ % files_.size()].string()};
    return options;
}

RegionOptions RandomRegions::pair() {
    const fs::path& west = one_of(random_, tiles_);
    const Corner corner = *corner_of(west);
    RegionOptions options;
    options.paths = {west.string()};
    for (const fs::path& east : tiles_)
        if (east.parent_path() == west.parent_path() && corner_of(east) == Corner{corner.lat, corner.lon + 1})
            options.paths.push_back(east.string());
    return options;
}

RegionOptions RandomRegions::box() {
    const fs::path& tile = one_of(random_, tiles_);
    const Corner corner = *corner_of(tile);
    const double lat = corner.lat + unit(random_), lon = corner.lon + unit(random_);
    const double tall = between(random_, 0.05, 0.7), wide = between(random_, 0.05, 0.9);
    RegionOptions options;
    options.paths = {tile.parent_path().string()};
    for (const double edge : {lon - wide, lat - tall, lon + wide, lat + tall})
        options.bbox += (options.bbox.empty() ? "" : ",") + number(rounded(edge, 1000.0));
    return options;
}

namespace {

struct Spot {
    double lat_deg;
    double lon_deg;
    std::optional<double> ground_m;
    [[nodiscard]] std::string text() const { return number(lat_deg) + "," + number(lon_deg); }
};

Spot spot_over(Random& random, const RegionToSee& over) {
    const PostGrid& grid = over.region.grids[0].field.grid;
    const double lat = between(random, grid.south_deg(), grid.north_deg());
    const double lon = between(random, grid.west_deg(), grid.east_deg());
    Spot spot{rounded(std::clamp(lat, -90.0, 90.0), 1e7), rounded(std::remainder(lon, 360.0), 1e7), {}};
    spot.ground_m = ground_h_m(over.region.grids[0].field, spot.lat_deg, spot.lon_deg, over.exaggeration);
    return spot;
}

void choose_eye(Random& random, const RegionToSee& over, ViewOptions& view) {
    const double above_m = rounded(0.5 * std::pow(8.0e5, unit(random)), 100.0);
    const Spot eye = spot_over(random, over);
    view.at = eye.text();
    view.above_m.reset();
    view.altitude_m.reset();
    // In a hole of the data: over all that surrounds it.
    if (eye.ground_m)
        view.above_m = above_m;
    else
        view.altitude_m = std::ceil(over.highest_H_m) + above_m;
    view.vertical_fov_deg = rounded(between(random, 5.0, 100.0), 10.0);
    view.heading_deg.reset();
    view.pitch_deg.reset();
    view.look_at.reset();
    view.roll_deg.reset();
    if (chance(random, 0.2)) view.roll_deg = rounded(between(random, -180.0, 180.0), 10.0);
    const double where = unit(random);
    const Spot target = spot_over(random, over);
    if (where < 0.35 && target.ground_m) {
        view.look_at = target.text();
        return;
    }
    view.heading_deg = rounded(between(random, 0.0, 360.0), 10.0);
    view.pitch_deg = where < 0.45   ? -90.0
                     : where < 0.55 ? 0.0
                     : where < 0.75 ? rounded(between(random, -30.0, 5.0), 10.0)
                                    : rounded(between(random, -90.0, -10.0), 10.0);
}

// Of what a user may ask for, what one asks for most of the time and what is rarely asked for.
void choose_world(Random& random, ViewOptions& view) {
    const double earth = unit(random), air = unit(random);
    if (earth > 0.6) view.earth = earth > 0.8 ? "sphere" : "flat";
    if (air > 0.6)
        view.air = "standard";
    else if (air > 0.35)
        view.refraction_k = air > 0.45 ? 0.13 : rounded(between(random, -0.3, 0.5), 100.0);
    if (chance(random, 0.2)) view.precision = "naive";
}

bool sees_ground(const RegionToSee& over, const TrueSurface& surface, const ViewOptions& options) {
    auto view = view_without_eye(options, {});
    if (!view.ok() || !place_eye(*view, options, over.region).ok()) return false;
    const Camera& camera = view->camera;
    const Oracle oracle(surface, sight_from(camera.eye));
    constexpr int across = 8, down = 6, least = 4;
    int hits = 0;
    for (int i = 0; i < across * down; ++i) {
        const glm::dvec2 point_px((i % across + 0.5) / across * camera.width_px,
                                  (i / across + 0.5) / down * camera.height_px);
        if (oracle.first_hit(camera.ecef_direction_at(point_px), sight_reach_m(camera.eye.h_m))) ++hits;
    }
    return hits >= least;
}

}  // namespace

RandomView random_view(Random& random, const RegionToSee& over, const TrueSurface& surface) {
    static const std::vector<std::string> sizes{"128x80", "128x80", "160x100", "80x128", "112x112"};
    ViewOptions view;
    view.size = one_of(random, sizes);
    if (over.exaggeration != 1.0) view.exaggeration = over.exaggeration;
    if (!over.geoid) view.geoid = "none";
    constexpr int tries = 30;
    choose_eye(random, over, view);
    for (int i = 0; i < tries && !sees_ground(over, surface, view); ++i) choose_eye(random, over, view);
    RandomView made;
    made.path = chance(random, 0.1) ? RasterPath::mesh : RasterPath::compute;
    view.pipeline = made.path == RasterPath::mesh ? "mesh" : "compute";
    made.toleranced = view;
    choose_world(random, view);
    made.drawing = view;
    // Half of the tolerances are asked for of the world as it is; in the same air, so that the truth is one.
    if (chance(random, 0.5)) made.toleranced = view;
    made.toleranced.refraction_k = view.refraction_k;
    if (chance(random, 0.5)) made.toleranced.air.reset();
    char tolerance[40];
    std::snprintf(tolerance, sizeof tolerance, "%.3g", 0.1 * std::pow(80.0, unit(random)));
    made.toleranced.tolerance = tolerance;
    made.drawing.tau_px = one_of(random, std::vector<double>{0.0, 0.0, 0.5, 1.0, 2.0, 4.0});
    if (chance(random, 0.3)) made.drawing.heights = "i16";
    return made;
}

std::string command_line(const RegionOptions& region, const ViewOptions& view) {
    std::string line = "orograph shot";
    for (const std::string& path : region.paths) line += " '" + path + "'";
    if (!region.bbox.empty()) line += " --bbox=" + region.bbox;
    if (region.fill_voids) line += " --fill-voids";
    ViewOptions given = view;
    for (const ViewOption& option : view_option_table()) {
        const OptionTarget target = option.target(given);
        if (const auto* const word = std::get_if<std::optional<std::string>*>(&target); word && **word)
            line += " " + option.name + "=" + ***word;
        if (const auto* const value = std::get_if<std::optional<double>*>(&target); value && **value)
            line += " " + option.name + "=" + number(***value);
    }
    return line + " --verify --out view.png";
}

}  // namespace oro::test
