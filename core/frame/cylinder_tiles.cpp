#include "core/frame/cylinder_tiles.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <numbers>

#include "core/base/parallel.h"
#include "core/base/srgb.h"

namespace oro {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;
constexpr int margin_px = 4;  // around what a tile is for: its pixels' means reach over its borders
constexpr int parts = 3;      // of a pixel, along each side
// ... with forests: as far as raise_canopy.comp looks down, and, of the picture's height to either side,
// where mirror_in_water.comp fades and lines that are upright in space lean.
constexpr int canopy_margin_px = 32;
constexpr double mirrored_share = 0.1;

std::array<float, 256> lights() {
    std::array<float, 256> all{};
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<float>(light_of_srgb(static_cast<double>(i) / 255.0));
    return all;
}

// The code whose light is nearest, in codes.
std::uint8_t code_of(float light) {
    const double code = srgb_of_light(static_cast<double>(light));
    return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * code), 0L, 255L));
}

// Cuts a length into parts of much the same length, `most` at most.
std::vector<int> borders(int length_px, double most_px, double shift_px) {
    const int count = std::max(1, static_cast<int>(std::ceil(length_px / std::max(1.0, most_px))));
    std::vector<int> all{0};
    for (int i = 1; i < count; ++i) {
        const auto at = static_cast<int>(std::lround(static_cast<double>(length_px) * i / count + shift_px));
        all.push_back(std::clamp(at, all.back() + 1, length_px - 1));
    }
    all.push_back(length_px);
    return all;
}

// How far right and up a tile reaches in its eye's picture, as tangents.
glm::dvec2 reach(const Cylinder& around, const CylinderTile& tile, const glm::dmat3& view_from_enu) {
    glm::dvec2 farthest(0.0);
    for (int down = 0; down <= 2; ++down) {
        for (int right = 0; right <= 2; ++right) {
            const glm::dvec3 seen = view_from_enu * around.enu_at({tile.x_px + 0.5 * right * tile.width_px,
                                                                   tile.y_px + 0.5 * down * tile.height_px});
            farthest = glm::max(farthest, glm::abs(glm::dvec2(seen) / -seen.z));
        }
    }
    return farthest;
}

glm::dmat3 view_from_enu(const Camera& camera) {
    return camera.view_from_ecef() * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
}

void aim(const Cylinder& around, const Geodetic& eye, CylinderTile& tile) {
    const double high_deg = around.elevation_deg_at(tile.y_px),
                 low_deg = around.elevation_deg_at(tile.y_px + tile.height_px);
    tile.camera.eye = eye;
    tile.camera.attitude = {around.azimuth_deg_at(tile.x_px + 0.5 * tile.width_px),
                            0.5 * (high_deg + low_deg), 0.0};
}

// unroll() looks within the tile, so what it reads ends where the tile's borders are seen. Around that: half
// a pixel to either side between pixels, one that a ridge line looks at, and one for the way between corners.
Tile part_of(const Cylinder& around, const CylinderTile& tile, int mirrored_px) {
    constexpr int beside_px = 3;
    const Camera& camera = tile.camera;
    const glm::dmat3 turn = view_from_enu(camera);
    const glm::dvec2 half_px = 0.5 * glm::dvec2(camera.width_px, camera.height_px),
                     scale_px = half_px / camera.half_fov_tangent();
    glm::dvec2 low = 2.0 * half_px, high(0.0);
    const auto see = [&](int x_px, int y_px) {
        const glm::dvec3 seen = turn * around.enu_at(glm::dvec2(x_px, y_px));
        const glm::dvec2 place = half_px + scale_px * glm::dvec2(seen.x, -seen.y) / -seen.z;
        low = glm::min(low, place);
        high = glm::max(high, place);
    };
    for (int x = tile.x_px; x <= tile.x_px + tile.width_px; ++x) {
        see(x, tile.y_px);
        see(x, tile.y_px + tile.height_px);
    }
    for (int y = tile.y_px; y <= tile.y_px + tile.height_px; ++y) {
        see(tile.x_px, y);
        see(tile.x_px + tile.width_px, y);
    }
    const auto begin = [&](double px) { return std::max(0, static_cast<int>(px) - beside_px); };
    const auto end = [&](double px, int last) {
        return std::min(last, static_cast<int>(px) + 1 + beside_px);
    };
    Tile part{begin(low.x - mirrored_px), begin(low.y)};
    part.width_px = end(high.x + mirrored_px, camera.width_px) - part.x_px;
    part.height_px = end(high.y, camera.height_px) - part.y_px;
    return part;
}

// How many pixels a radian a tile's picture has in its middle: the cylinder has more the farther from level.
double scale_px(const Cylinder& around, const CylinderTile& tile, const CylinderCut& cut) {
    const double top_rad = around.elevation_deg_at(tile.y_px) * rad_per_deg,
                 bottom_rad = around.elevation_deg_at(tile.y_px + tile.height_px) * rad_per_deg;
    const double finest = cut.oversampling * around.px_per_rad();
    if (!cut.with_forests) {
        const double cosine = std::cos(std::max(std::abs(top_rad), std::abs(bottom_rad)));
        return finest / (cosine * cosine);
    }
    // So has a picture, from its own middle.
    const auto times = [&](double at_rad) {
        const double own = std::cos(at_rad - 0.5 * (top_rad + bottom_rad)) / std::cos(at_rad);
        return own * own;
    };
    return finest * std::max({1.0, times(top_rad), times(bottom_rad)});
}

// How many of the cylinder's rows a tile has at most.
double most_rows_px(const Cylinder& around, const CylinderCut& cut, double side_px) {
    if (!cut.with_forests) return side_px;
    return std::min(1.5 * cut.largest_side_px / (1.2 * cut.oversampling), 2.0 * around.px_per_rad());
}

}  // namespace

std::vector<CylinderTile> cylinder_tiles(const Cylinder& around, const Geodetic& eye,
                                         const CylinderCut& cut) {
    // So many pixels of the cylinder's level line make a tile's side.
    const double side_px = std::min(cut.largest_side_px / (1.2 * cut.oversampling),
                                    cut.widest_deg * rad_per_deg * around.px_per_rad());
    const std::vector<int> columns = borders(around.width_px, side_px, cut.shift_px),
                           rows = borders(around.height_px(), most_rows_px(around, cut, side_px), 0.0);
    std::vector<CylinderTile> tiles;
    std::vector<double> scales_px;
    glm::dvec2 largest_px(0.0);
    for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
        for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
            CylinderTile tile{columns[column],           rows[row], columns[column + 1] - columns[column],
                              rows[row + 1] - rows[row], {},        {}};
            aim(around, eye, tile);
            // Rows lie closer together, in angle, the farther they are from the level line.
            scales_px.push_back(scale_px(around, tile, cut));
            largest_px =
                glm::max(largest_px, scales_px.back() * reach(around, tile, view_from_enu(tile.camera)));
            tiles.push_back(tile);
        }
    }
    const int above_px = cut.with_forests ? canopy_margin_px : margin_px;
    const int half_height_px = static_cast<int>(std::ceil(largest_px.y)) + above_px;
    const int mirrored_px =
        cut.with_forests ? static_cast<int>(std::ceil(2.0 * mirrored_share * half_height_px)) : 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        Camera& camera = tiles[i].camera;
        camera.width_px = 2 * (static_cast<int>(std::ceil(largest_px.x)) + margin_px + mirrored_px);
        camera.height_px = 2 * half_height_px;
        camera.vertical_fov_deg = 2.0 * std::atan(0.5 * camera.height_px / scales_px[i]) / rad_per_deg;
        tiles[i].part = part_of(around, tiles[i], mirrored_px);
    }
    return tiles;
}

namespace {

// A tile's picture as light that can be read between its pixels.
class LightPicture {
  public:
    LightPicture(const Camera& camera, std::span<const std::uint8_t> rgb)
        : width_px_(camera.width_px), height_px_(camera.height_px), rgb_(rgb), lights_(lights()) {}

    // Between the middles of four pixels; places beyond the picture's are its border's.
    [[nodiscard]] glm::vec3 at(const glm::dvec2& place_px) const {
        const double x = std::clamp(place_px.x - 0.5, 0.0, width_px_ - 1.001),
                     y = std::clamp(place_px.y - 0.5, 0.0, height_px_ - 1.001);
        const auto left = static_cast<std::size_t>(x), top = static_cast<std::size_t>(y);
        const auto right = static_cast<float>(x - static_cast<double>(left)),
                   down = static_cast<float>(y - static_cast<double>(top));
        return glm::mix(glm::mix(light(left, top), light(left + 1, top), right),
                        glm::mix(light(left, top + 1), light(left + 1, top + 1), right), down);
    }

  private:
    [[nodiscard]] glm::vec3 light(std::size_t x, std::size_t y) const {
        const std::uint8_t* const pixel = &rgb_[3 * (y * static_cast<std::size_t>(width_px_) + x)];
        return {lights_[pixel[0]], lights_[pixel[1]], lights_[pixel[2]]};
    }
    int width_px_;
    int height_px_;
    std::span<const std::uint8_t> rgb_;
    std::array<float, 256> lights_;
};

}  // namespace

void unroll(const Cylinder& around, const CylinderTile& tile, std::span<const std::uint8_t> drawn,
            std::span<std::uint8_t> rgb, int threads) {
    const Camera& camera = tile.camera;
    assert(drawn.size() ==
           3 * static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px));
    const LightPicture picture(camera, drawn);
    const glm::dmat3 turn = view_from_enu(camera);
    const glm::dvec2 half_px = 0.5 * glm::dvec2(camera.width_px, camera.height_px),
                     scale_px = half_px / camera.half_fov_tangent();
    // Each row shares the azimuths of its columns' parts.
    std::vector<glm::dvec3> ahead(static_cast<std::size_t>(tile.width_px) * parts);
    for (std::size_t i = 0; i < ahead.size(); ++i)
        ahead[i] = turn * around.enu_at({tile.x_px + (static_cast<double>(i) + 0.5) / parts,
                                         static_cast<double>(around.above_px)});
    const glm::dvec3 up = turn[2];
    in_parallel(tile.height_px, threads, [&](int row) {
        std::array<glm::dvec3, parts> raised;
        for (int part = 0; part < parts; ++part)
            raised[static_cast<std::size_t>(part)] =
                up * around.enu_at({0.0, tile.y_px + row + (part + 0.5) / parts}).z;
        std::uint8_t* to =
            &rgb[3 * (static_cast<std::size_t>(tile.y_px + row) * static_cast<std::size_t>(around.width_px) +
                      static_cast<std::size_t>(tile.x_px))];
        for (std::size_t column = 0; column < static_cast<std::size_t>(tile.width_px); ++column, to += 3) {
            glm::vec3 sum(0.0F);
            for (const glm::dvec3& high : raised) {
                for (std::size_t part = 0; part < parts; ++part) {
                    const glm::dvec3 seen = ahead[column * parts + part] + high;
                    sum += picture.at(half_px + scale_px * glm::dvec2(seen.x, -seen.y) / -seen.z);
                }
            }
            sum /= static_cast<float>(parts * parts);
            for (int i = 0; i < 3; ++i) to[i] = code_of(sum[i]);
        }
    });
}

}  // namespace oro
