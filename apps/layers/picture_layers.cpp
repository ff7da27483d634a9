#include "apps/layers/picture_layers.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <span>

#include "apps/command_line/refusals.h"
#include "apps/labels/labelled_picture.h"
#include "core/base/parallel.h"
#include "core/measure/shown_place.h"
#include "core/terrain/horn_slope.h"
#include "geo/posts/source_at.h"
#include "render/frame/shown_ground.h"

namespace oro {
namespace {

constexpr double most_px = 1.0e8;  // they take 40 bytes each
constexpr float none = std::numeric_limits<float>::quiet_NaN();

// Whether the sun's middle shows over the terrain: by straight lines towards where the eye sees it, as
// pictures cast shadows.
class SunOverPlaces {
  public:
    SunOverPlaces(const TrueGround& ground, const Geodetic& eye, const SunDirection& sun)
        : ground_(ground), oracle_(ground, sight_from(eye)), light_(direct_light(sun)) {
        const SineCosine around = sine_cosine_deg(sun.azimuth_deg), up = sine_cosine_deg(sun.elevation_deg);
        towards_ = ecef_from_enu(eye.lat_deg, eye.lon_deg) *
                   glm::dvec3(up.cosine * around.sine, up.cosine * around.cosine, up.sine);
    }

    // beside_grids: the place is on a mesh or on a step, whose height is its own.
    [[nodiscard]] float share_at(const ShownPlace& place, bool beside_grids) const {
        // A line begins above the true ground, or it would meet what it begins on.
        constexpr double lift_m = 0.02;
        const auto ground_m = ground_.surface(place.grid).h_at_m(place.row, place.column);
        if (!ground_m) return none;
        if (light_ <= 0.0) return 0.0F;
        const double h_m = beside_grids ? std::max(place.point.h_m, *ground_m) : *ground_m;
        const Geodetic from{place.point.lat_deg, place.point.lon_deg, h_m + lift_m};
        const bool hidden =
            oracle_.first_hit_from(ecef_from_geodetic(from), towards_, sight_reach_m(from.h_m)).has_value();
        return hidden ? 0.0F : static_cast<float>(light_);
    }

  private:
    TrueGround ground_;
    Oracle oracle_;
    double light_;
    glm::dvec3 towards_{};
};

PictureLayers empty_layers(std::size_t pixels) {
    PictureLayers layers;
    for (auto* values : {&layers.longitude_deg, &layers.latitude_deg})
        values->assign(pixels, std::numeric_limits<double>::quiet_NaN());
    for (auto* values :
         {&layers.H_m, &layers.h_m, &layers.distance_m, &layers.slope_deg, &layers.source, &layers.shadow})
        values->assign(pixels, none);
    return layers;
}

float number_of_source(const RegionGround& ground, std::size_t grid, const Geodetic& point) {
    const RegionGrid& of = ground.grid(grid);
    const SourceReport* const source = source_at(of, point.lat_deg, point.lon_deg);
    if (!source) return none;
    std::size_t before = 0;
    for (std::size_t other = 0; other < grid; ++other) before += ground.grid(other).sources.size();
    return static_cast<float>(before) + static_cast<float>(source - of.sources.data());
}

// All that is told of a place, into a pixel.
void put(const ShownPlace& place, bool beside_grids, const View& view, const RegionGround& ground,
         const SunOverPlaces& sun, std::size_t pixel, PictureLayers& layers) {
    const RegionGrid& grid = ground.grid(place.grid);
    const Geodetic& point = place.point;
    const double N_m = grid.field.undulation.at_m(point.lat_deg, point.lon_deg);
    const double H_m = (point.h_m - N_m) / view.exaggeration;
    layers.longitude_deg[pixel] = point.lon_deg;
    layers.latitude_deg[pixel] = point.lat_deg;
    layers.H_m[pixel] = static_cast<float>(H_m);
    // Where the view goes without a geoid, the ellipsoid is still as far below it.
    layers.h_m[pixel] =
        static_cast<float>(H_m + N_m + grid.geoid_left_out.at_m(point.lat_deg, point.lon_deg));
    layers.distance_m[pixel] = static_cast<float>(place.distance_m);
    if (const auto slope_deg = horn_slope_deg(grid.field, place.row, place.column))
        layers.slope_deg[pixel] = static_cast<float>(*slope_deg);
    layers.source[pixel] = number_of_source(ground, place.grid, point);
    layers.shadow[pixel] = sun.share_at(place, beside_grids);
}

// The land cover of all pixels that show ground, row by row: each pixel's place is known.
Result<void> add_cover(const CoverMap& cover, const Camera& camera, PictureLayers& layers) {
    const auto width = static_cast<std::size_t>(camera.width_px);
    layers.cover.assign(layers.latitude_deg.size(), none);
    std::mutex one_at_a_time;
    Result<void> all;
    in_parallel(camera.height_px, thread_count(), [&](int row) {
        const std::size_t first = static_cast<std::size_t>(row) * width;
        std::vector<int> codes(width, no_cover_code);
        const Result<void> found =
            cover.codes_at(std::span(layers.latitude_deg).subspan(first, width),
                           std::span(layers.longitude_deg).subspan(first, width), codes);
        for (std::size_t i = 0; i < width; ++i)
            if (codes[i] != no_cover_code) layers.cover[first + i] = static_cast<float>(codes[i]);
        if (found.ok()) return;
        const std::scoped_lock lock(one_at_a_time);
        if (all.ok()) all = found;
    });
    return all;
}

// The features of meshes in pixels that show what is no grid's: as the oracle sees them.
class FeaturesInPixels {
  public:
    FeaturesInPixels(const RegionGround& ground, const Region& region, const View& view)
        : grids_(ground.ground().grids()), camera_(view.camera) {
        if (!region.meshes) return;
        oracle_.emplace(ground.ground(), sight_of(view.model, view.camera.eye));
        std::uint32_t before = 0;
        for (const PlacedMesh& mesh : *region.meshes) {
            before_.push_back(before);
            before += static_cast<std::uint32_t>(mesh.features.size());
        }
    }
    [[nodiscard]] bool any() const { return oracle_.has_value(); }
    [[nodiscard]] float at(const ShownTriangle& shown, glm::dvec2 point_px) const {
        if (!oracle_ || shown.grid < grids_) return none;
        const auto hit =
            oracle_->first_hit(camera_.ecef_direction_at(point_px), sight_reach_m(camera_.eye.h_m));
        if (!hit || hit->mesh == 0 || hit->feature == 0) return none;
        return static_cast<float>(before_[hit->mesh - 1] + hit->feature);
    }

  private:
    std::size_t grids_;
    Camera camera_;
    std::optional<Oracle> oracle_;
    std::vector<std::uint32_t> before_;  // features of the meshes before each
};

double pixels_of(const Camera& camera) {
    return static_cast<double>(camera.width_px) * camera.height_px;
}

}  // namespace

Result<void> check_layers(const Camera& camera) {
    if (pixels_of(camera) <= most_px) return {};
    return refused("--layers", "", "takes a picture of at most 100,000,000 pixels: give a smaller --size");
}

Result<PictureLayers> picture_layers(const Gpu& gpu, Scene& scene, const View& view,
                                     const RegionGround& ground, const Style& style, RasterPath path,
                                     const RenderProgress& progress) {
    const Camera& camera = view.camera;
    PictureLayers layers = empty_layers(static_cast<std::size_t>(pixels_of(camera)));
    const ShownPlaces places(ground.ground(), camera, view.model, view.tau_px == 0.0);
    const FeaturesInPixels features(ground, ground.region(), view);
    if (features.any()) layers.feature.assign(layers.source.size(), none);
    const SunOverPlaces sun(ground.ground(), camera.eye, style.sun);
    std::atomic<std::uint64_t> ground_px{0};
    const auto take = [&](const Tile& tile, int first_row, int rows,
                          const std::vector<ShownTriangle>& triangles) {
        in_parallel(rows, thread_count(), [&](int row) {
            const int y = tile.y_px + first_row + row;
            for (int column = 0; column < tile.width_px; ++column) {
                const int x = tile.x_px + column;
                const ShownTriangle& shown =
                    triangles[static_cast<std::size_t>(row) * static_cast<std::size_t>(tile.width_px) +
                              static_cast<std::size_t>(column)];
                const auto place = places.at(shown, {x + 0.5, y + 0.5});
                if (!place) continue;
                ++ground_px;
                const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width_px) +
                                   static_cast<std::size_t>(x);
                put(*place, shown.grid >= ground.ground().grids(), view, ground, sun, pixel, layers);
                if (features.any()) layers.feature[pixel] = features.at(shown, {x + 0.5, y + 0.5});
            }
        });
        if (progress) progress(static_cast<double>(tile.y_px + first_row + rows) / camera.height_px);
    };
    ORO_CHECK(shown_triangles(gpu, scene, camera, picture_options(view, path), take));
    // What could not be read counted as void.
    ORO_CHECK(ground.ground().health());
    if (view.cover) ORO_CHECK(add_cover(*view.cover, camera, layers));
    layers.ground_px = ground_px;
    layers.missed_px = places.missed();
    return layers;
}

}  // namespace oro
