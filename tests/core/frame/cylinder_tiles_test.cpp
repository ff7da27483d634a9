// Tiles of a cylinder: each pixel has one, which sees all of it; and what they are unrolled to.
#include "core/frame/cylinder_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <vector>

namespace oro {
namespace {

const Geodetic cylinder_eye{46.5, 8.1, 3000.0};

std::vector<Cylinder> cylinders() {
    return {cylinder_around(0.0, 360.0, -14.0, 4.0, 1000), cylinder_around(300.0, 120.0, -35.0, 35.0, 777),
            cylinder_around(10.0, 0.5, -0.2, 0.2, 300), cylinder_around(0.0, 360.0, -75.0, 75.0, 333),
            cylinder_around(90.0, 90.0, 20.0, 60.0, 400)};
}

TEST(CylinderTiles, AreEachPixelOnce) {
    for (const Cylinder& around : cylinders()) {
        std::vector<int> covered(static_cast<std::size_t>(around.width_px) *
                                 static_cast<std::size_t>(around.height_px()));
        const std::vector<CylinderTile> tiles = cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 3.0});
        const bool is_level =
            std::max(around.elevation_deg_at(0.0), -around.elevation_deg_at(around.height_px())) < 36.0;
        for (const CylinderTile& tile : tiles) {
            EXPECT_EQ(tile.camera.width_px, tiles.front().camera.width_px);
            EXPECT_EQ(tile.camera.height_px, tiles.front().camera.height_px);
            EXPECT_LE(tile.camera.width_px, is_level ? 640 : 1536);
            EXPECT_LE(tile.camera.height_px, is_level ? 640 : 1536);
            for (int y = tile.y_px; y < tile.y_px + tile.height_px; ++y) {
                for (int x = tile.x_px; x < tile.x_px + tile.width_px; ++x)
                    ++covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(around.width_px) +
                              static_cast<std::size_t>(x)];
            }
        }
        EXPECT_TRUE(std::ranges::all_of(covered, [](int count) { return count == 1; })) << around.width_px;
    }
}

// All that belongs to a tile, and so many pixels more on each side, is in its eye's picture; and there it is
// as much finer as was asked for, or more.
void see_finely(const Cylinder& around, const CylinderTile& tile, const glm::dvec2& beside_px) {
    const Camera& camera = tile.camera;
    const glm::dmat3 turn =
        camera.view_from_ecef() * ecef_from_enu(cylinder_eye.lat_deg, cylinder_eye.lon_deg);
    const auto seen_px = [&](double x, double y) {
        const glm::dvec3 seen = turn * around.enu_at({x, y});
        EXPECT_LT(seen.z, 0.0);
        return 0.5 * glm::dvec2(camera.width_px, camera.height_px) *
               (1.0 + glm::dvec2(seen.x, -seen.y) / -seen.z / camera.half_fov_tangent());
    };
    for (int i = 0; i <= 8; ++i) {
        for (int j = 0; j <= 8; ++j) {
            const double x = tile.x_px + i / 8.0 * tile.width_px, y = tile.y_px + j / 8.0 * tile.height_px;
            const glm::dvec2 at = seen_px(x, y);
            EXPECT_GE(at.x, beside_px.x);
            EXPECT_GE(at.y, beside_px.y);
            EXPECT_LE(at.x, camera.width_px - beside_px.x);
            EXPECT_LE(at.y, camera.height_px - beside_px.y);
            EXPECT_GE(glm::length(seen_px(x + 0.01, y) - at), 0.01 * 1.9) << x << " " << y;
            EXPECT_GE(glm::length(seen_px(x, y + 0.01) - at), 0.01 * 1.9) << x << " " << y;
        }
    }
}
TEST(CylinderTiles, SeeWhatTheyAreForFinely) {
    for (const Cylinder& around : cylinders())
        for (const CylinderTile& tile : cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 0.0}))
            see_finely(around, tile, glm::dvec2(2.0));
}

// Where forests rise 32 px at most and water mirrors, which fades over 0.06 of a picture's height.
TEST(CylinderTiles, SeeWhatIsBesideThemOverForests) {
    for (const Cylinder& around : cylinders())
        for (const CylinderTile& tile : cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 0.0, true})) {
            see_finely(around, tile, {0.1 * tile.camera.height_px, 32.0});
            const Tile& part = tile.part;
            EXPECT_GE(part.x_px, 0);
            EXPECT_LE(part.x_px + part.width_px, tile.camera.width_px);
        }
    // Up to 90 degrees from top to bottom they have no border across, where trees would be seen to end.
    const Cylinder high = cylinder_around(300.0, 120.0, -45.0, 30.0, 300);
    for (const CylinderTile& tile : cylinder_tiles(high, cylinder_eye, {2.0, 2048, 45.0, 0.0, true}))
        EXPECT_EQ(tile.height_px, high.height_px());
}

// Of a tile's picture unroll() reads its part alone, and of the part's rim nothing: ridge lines there lack a
// neighbour.
TEST(CylinderTiles, AreUnrolledFromTheirParts) {
    for (const Cylinder& around : cylinders()) {
        const std::size_t bytes =
            3 * static_cast<std::size_t>(around.width_px) * static_cast<std::size_t>(around.height_px());
        std::vector<std::uint8_t> whole(bytes), of_parts(bytes);
        double all_px = 0.0, part_px = 0.0;
        for (const CylinderTile& tile : cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 0.0})) {
            const Camera& camera = tile.camera;
            EXPECT_GE(std::min(tile.part.x_px, tile.part.y_px), 0);
            EXPECT_LE(tile.part.x_px + tile.part.width_px, camera.width_px);
            EXPECT_LE(tile.part.y_px + tile.part.height_px, camera.height_px);
            std::vector<std::uint8_t> drawn, in_part;
            for (int y = 0; y < camera.height_px; ++y) {
                for (int x = 0; x < camera.width_px; ++x) {
                    const auto value = static_cast<std::uint8_t>((7 * x + 13 * y + x * y / 5) % 200);
                    const bool is_within = x > tile.part.x_px &&
                                           x + 1 < tile.part.x_px + tile.part.width_px &&
                                           y > tile.part.y_px && y + 1 < tile.part.y_px + tile.part.height_px;
                    for (int i = 0; i < 3; ++i) {
                        drawn.push_back(value);
                        in_part.push_back(is_within ? value : 255);
                    }
                }
            }
            unroll(around, tile, drawn, whole, 2);
            unroll(around, tile, in_part, of_parts, 2);
            all_px += static_cast<double>(camera.width_px) * camera.height_px;
            part_px += static_cast<double>(tile.part.width_px) * tile.part.height_px;
        }
        EXPECT_EQ(whole, of_parts) << around.width_px;
        EXPECT_LT(part_px, 1.0001 * all_px);
    }
}

// A scene whose colours are its directions: each pixel has the colour of its own direction, within a code for
// the rounding of the drawn pictures and one for its own; on both sides of every border, too.
TEST(CylinderTiles, UnrollToTheColoursOfTheirDirections) {
    const auto code = [](double value) {
        return static_cast<std::uint8_t>(std::lround(127.5 + 127.0 * std::clamp(value, -1.0, 1.0)));
    };
    for (const Cylinder& around : cylinders()) {
        std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(around.width_px) *
                                      static_cast<std::size_t>(around.height_px()));
        const glm::dmat3 enu_from_ecef =
            glm::transpose(ecef_from_enu(cylinder_eye.lat_deg, cylinder_eye.lon_deg));
        for (const CylinderTile& tile : cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 0.0})) {
            std::vector<std::uint8_t> drawn;
            for (int y = 0; y < tile.camera.height_px; ++y) {
                for (int x = 0; x < tile.camera.width_px; ++x) {
                    const glm::dvec3 enu = enu_from_ecef * tile.camera.ecef_direction_at({x + 0.5, y + 0.5});
                    for (int i = 0; i < 3; ++i) drawn.push_back(code(enu[i]));
                }
            }
            unroll(around, tile, drawn, rgb, 2);
        }
        int farthest = 0;
        for (int y = 0; y < around.height_px(); ++y) {
            for (int x = 0; x < around.width_px; ++x) {
                const glm::dvec3 enu = glm::normalize(around.enu_at({x + 0.5, y + 0.5}));
                const std::size_t at =
                    3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(around.width_px) +
                         static_cast<std::size_t>(x));
                for (int i = 0; i < 3; ++i)
                    farthest = std::max(
                        farthest,
                        std::abs(static_cast<int>(rgb[at + static_cast<std::size_t>(i)]) - code(enu[i])));
            }
        }
        EXPECT_LE(farthest, 2) << around.width_px;
    }
}

// Waves 16 px long, across and down: a tenth of a pixel off would be 5 codes.
TEST(CylinderTiles, UnrollToTheirPlaces) {
    const auto wave = [](double px) {
        return static_cast<std::uint8_t>(
            std::lround(127.5 + 80.0 * std::sin(px * 2.0 * std::numbers::pi / 16.0)));
    };
    for (const Cylinder& around :
         {cylinder_around(0.0, 360.0, -14.0, 4.0, 1600), cylinder_around(300.0, 120.0, -35.0, 35.0, 800)}) {
        std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(around.width_px) *
                                      static_cast<std::size_t>(around.height_px()));
        const glm::dmat3 enu_from_ecef =
            glm::transpose(ecef_from_enu(cylinder_eye.lat_deg, cylinder_eye.lon_deg));
        for (const CylinderTile& tile : cylinder_tiles(around, cylinder_eye, {2.0, 512, 45.0, 0.0})) {
            std::vector<std::uint8_t> drawn;
            for (int y = 0; y < tile.camera.height_px; ++y) {
                for (int x = 0; x < tile.camera.width_px; ++x) {
                    const glm::dvec2 place =
                        around.place_px(enu_from_ecef * tile.camera.ecef_direction_at({x + 0.5, y + 0.5}));
                    drawn.insert(drawn.end(), {wave(place.x), wave(place.y), 0});
                }
            }
            unroll(around, tile, drawn, rgb, 2);
        }
        int farthest = 0;
        for (int y = 0; y < around.height_px(); ++y) {
            // Outside a sector's borders places count from its other side.
            for (int x = 2; x < around.width_px - 2; ++x) {
                const std::size_t at =
                    3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(around.width_px) +
                         static_cast<std::size_t>(x));
                farthest = std::max({farthest, std::abs(static_cast<int>(rgb[at]) - wave(x + 0.5)),
                                     std::abs(static_cast<int>(rgb[at + 1]) - wave(y + 0.5))});
            }
        }
        EXPECT_LE(farthest, 5) << around.width_px;
    }
}

// Black and white stripes as fine as the tile's pixels become the grey of half the light, sRGB 188, and not
// that of half the code.
TEST(CylinderTiles, MixLightAndNotCodes) {
    const Cylinder around = cylinder_around(0.0, 20.0, -5.0, 5.0, 200);
    const std::vector<CylinderTile> tiles = cylinder_tiles(around, cylinder_eye, {2.0, 2048, 45.0, 0.0});
    ASSERT_EQ(tiles.size(), 1U);
    const Camera& camera = tiles.front().camera;
    std::vector<std::uint8_t> drawn;
    for (int y = 0; y < camera.height_px; ++y)
        drawn.insert(drawn.end(), 3 * static_cast<std::size_t>(camera.width_px), y % 2 == 0 ? 0 : 255);
    std::vector<std::uint8_t> rgb(3 * 200 * static_cast<std::size_t>(around.height_px()));
    unroll(around, tiles.front(), drawn, rgb, 1);
    double sum = 0.0;
    for (const std::uint8_t one : rgb) sum += one;
    EXPECT_NEAR(sum / static_cast<double>(rgb.size()), 188.0, 3.0);
}

}  // namespace
}  // namespace oro
