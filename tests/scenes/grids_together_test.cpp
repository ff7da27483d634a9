// Grids that lie over each other are one surface: no background shines through where they meet, from any eye,
// and what is drawn is what brute force finds.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/measure/picture_errors.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/ground.h"
#include "geo/together/cut_regions.h"
#include "geo/together/region_ground.h"
#include "render/frame/depth_picture.h"
#include "render/frame/frame_renderer.h"
#include "render/scene/scene.h"
#include "tests/scenes/scene_of_grids.h"
#include "tests/support/asked_count.h"
#include "tests/support/brute_depths.h"
#include "tests/support/drawn/made_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

gpu::FrameStyle plain_style() {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.5F);
    style.sun_enu = gpu::vec3(0.0F, 0.6F, 0.8F);
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    return style;
}

class GridsTogether : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    void open(Region region) {
        region_ = std::move(region);
        auto cuts = cut_regions(region_);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        cuts_ = std::move(cuts).value();
        seam_ = seam_between(region_, cuts_, 1.0);
        for (const RegionGrid& grid : region_.grids) {
            none_decide_.emplace_back(grid.field.grid.post_count(), char{1});
        }
        scene_.emplace(test::scene_of_grids(*gpu_, region_, cuts_, seam_));
    }
    std::vector<float> depths(const Camera& camera, double tau_px) {
        const auto width = static_cast<std::uint32_t>(camera.width_px),
                   height = static_cast<std::uint32_t>(camera.height_px);
        if (!renderer_) {
            FrameRendererOptions options;
            options.extent = {width, height};
            options.path = GetParam();
            options.keep_depths = true;
            renderer_.emplace(test::made_renderer(*gpu_, options));
        }
        const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
        auto plan = scene_->settled_plan({camera, tile, tau_px});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        near_m_ = static_cast<double>(plan->grids[0].constants.near_m);
        auto report = renderer_->draw(std::move(*plan), plain_style(), 0, 1);
        EXPECT_TRUE(report.ok()) << report.error().line();
        return *renderer_->read_depths(width, height);
    }
    // Over a random place of a rim, or of anything near the middle.
    Camera camera_over_rim(std::mt19937& random, int picture_side_px, double highest_m) const {
        const auto between = [&](double a, double b) {
            return std::uniform_real_distribution<double>(a, b)(random);
        };
        const SeamSkirt& skirt = seam_.skirts[random() % seam_.skirts.size()];
        const PostPlace at = place_of_normal(skirt.up);
        Camera camera;
        const double lat_deg = at.lat_deg + between(-0.002, 0.002),
                     lon_deg = at.lon_deg + between(-0.002, 0.002);
        // Whichever diagonal is drawn: cells beside what is cut out fall.
        double ground_m = -1000.0;
        for (std::size_t i = 0; i < none_decide_.size(); ++i) {
            const HeightField& field = region_.grids[i].field;
            ground_m = std::max({ground_m, ground_h_m(field, lat_deg, lon_deg).value_or(-1000.0),
                                 field.surface_H_m(lat_deg, lon_deg, &none_decide_[i]).value_or(-1000.0) +
                                     field.undulation.at_m(lat_deg, lon_deg)});
        }
        camera.eye = {lat_deg, lon_deg, ground_m + std::exp(between(std::log(3.0), std::log(highest_m)))};
        camera.attitude = {between(0, 360), between(-90, -45), between(-180, 180)};
        camera.vertical_fov_deg = 35.0;
        camera.width_px = camera.height_px = picture_side_px;
        return camera;
    }

    Region region_;
    std::vector<std::vector<char>> none_decide_;  // of each grid's posts: left out, so that all cells fall
    RegionCuts cuts_;
    Seam seam_;
    std::optional<Scene> scene_;
    std::optional<FrameRenderer> renderer_;
    double near_m_{};
};

// A view of LeaveNoGap that had a pixel of background: a wall from above, along its own plane.
constexpr int once_open_view = 5414;

// Eyes that see ground alone: over the middle of the region, looking down. 500 of them and what was once
// open; 10,000 take OROGRAPH_TEST_VIEWS=10000.
TEST_P(GridsTogether, LeaveNoGap) {
    constexpr unsigned seed = 81;
    const int views = test::asked_count("OROGRAPH_TEST_VIEWS", 500);
    std::mt19937 random(seed);
    open(test::three_grids(700));
    std::size_t background = 0, pixels = 0;
    int shown = 0;
    for (int i = 0; i < std::max(views, once_open_view + 1); ++i) {
        const Camera camera = camera_over_rim(random, 64, 6000.0);
        const double taus[] = {0.0, 0.25, 0.5, 1.0, 2.0, 4.0};
        const double tau_px = taus[random() % 6];
        if (i >= views && i != once_open_view) continue;
        const std::vector<float> drawn = depths(camera, tau_px);
        const auto holes = static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), 0.0F));
        if (holes > 0 && ++shown <= 5)
            std::printf("view %d, tau %g: %zu background pixels; eye %.6f, %.6f, h %.1f\n", i, tau_px, holes,
                        camera.eye.lat_deg, camera.eye.lon_deg, camera.eye.h_m);
        background += holes;
        pixels += drawn.size();
    }
    std::printf("seed %u: %d views, %zu pixels, %zu of background; %zu pieces, %zu closers\n", seed, views,
                pixels, background, seam_.pieces.size(), seam_.skirts.size());
    EXPECT_EQ(background, 0U);
}

// Two grids side by side, their rims one post apart, or less where they are turned; and a third whose posts
// are the middles of its cells.
Region adjacent_grids() {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::rough_field(47.0, 8.0, 200, 200);
    region.grids[0].rank = 0;
    const double east_deg = region.grids[0].field.grid.east_deg(),
                 step_deg = region.grids[0].field.grid.lon.spacing_deg();
    const auto add = [&](HeightField field, int rank) {
        RegionGrid& other = region.grids.emplace_back();
        other.field = std::move(field);
        other.rank = rank;
    };
    add(test::rough_field(47.0 - 0.4 * step_deg, east_deg + 0.9 * step_deg, 200, 150), 1);
    const PostPlace below{47.0 - 199.0 * step_deg - 1.2 * step_deg - 0.5 * 120 * 60.0 / 111'200.0,
                          8.0 + 0.08};
    const test::PlaneOfPosts plane{121, 181, below, 60.0, 0.0};
    add(test::net_field(plane,
                        [&](double row, double column) {
                            const PostPlace at = plane.place_of(row, column);
                            return static_cast<float>(test::rough_H_m(at.lat_deg, at.lon_deg));
                        }),
        2);
    return region;
}

// No background shines through between grids that lie a post apart, and what is drawn there has no height
// that the posts around have not.
TEST_P(GridsTogether, JoinOverGaps) {
    constexpr unsigned seed = 84;
    std::mt19937 random(seed);
    open(adjacent_grids());
    ASSERT_GT(cuts_.bridges.size(), 300U);
    const std::vector<RegionGrid>& grids = region_.grids;
    double longest_m = 0.0;
    std::size_t over_ground = 0;
    for (const GapBridge& bridge : cuts_.bridges) {
        glm::dvec3 middle(0.0);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto place = [&](const BridgePost& post) {
                return post_ecef(grids[post.grid].field, post.post.row, post.post.column, 0.0).m;
            };
            longest_m =
                std::max(longest_m, glm::length(place(bridge.posts[i]) - place(bridge.posts[(i + 1) % 3])));
            middle += place(bridge.posts[i]) / 3.0;
        }
        const Geodetic at = geodetic_from_ecef({middle});
        for (const RegionGrid& grid : grids)
            over_ground += ground_h_m(grid.field, at.lat_deg, at.lon_deg) ? 1U : 0U;
    }
    std::size_t background = 0, pixels = 0;
    for (int i = 0; i < 200; ++i) {
        // Over the joint between the first two, and that below the first; not near its ends.
        const bool east = random() % 2 == 0;
        const double share = std::uniform_real_distribution<double>(0.25, 0.75)(random);
        const PostGrid& grid = region_.grids[0].field.grid;
        const double lat_deg = east ? std::lerp(grid.south_deg(), grid.north_deg(), share)
                                    : grid.south_deg() - 0.0005,
                     lon_deg =
                         east ? grid.east_deg() + 0.0004 : std::lerp(grid.west_deg(), grid.east_deg(), share);
        Camera camera;
        const double above_m =
            std::exp(std::uniform_real_distribution<double>(std::log(20.0), std::log(1500.0))(random));
        camera.eye = {lat_deg, lon_deg, test::rough_H_m(lat_deg, lon_deg) + above_m};
        camera.attitude = {std::uniform_real_distribution<double>(0.0, 360.0)(random), -90.0, 0.0};
        camera.vertical_fov_deg = 35.0;
        camera.width_px = camera.height_px = 64;
        const double taus[] = {0.0, 0.5, 1.0, 4.0};
        const std::vector<float> drawn = depths(camera, taus[random() % 4]);
        background += static_cast<std::size_t>(std::count(drawn.begin(), drawn.end(), 0.0F));
        pixels += drawn.size();
    }
    std::printf(
        "seed %u: %zu bridges, sides of at most %.1f m, %zu over ground; %zu pixels, %zu of background\n",
        seed, cuts_.bridges.size(), longest_m, over_ground, pixels, background);
    EXPECT_EQ(over_ground, 0U);
    EXPECT_LT(longest_m, std::hypot(2.0, 1.0) * 92.8);
    EXPECT_EQ(background, 0U);
}

// All that is drawn at full resolution, from an eye: the three grids' own triangles, whole or left out, and
// the seam.
std::vector<test::NearTriangle> all_triangles(const Region& region, const RegionCuts& cuts, const Seam& seam,
                                              const glm::dvec3& eye) {
    std::vector<test::NearTriangle> all;
    const std::vector<RegionGrid>& grids = region.grids;
    for (std::size_t grid = 0; grid < grids.size(); ++grid) {
        const HeightField rest = test::rest_of(grids[grid].field, cuts.grids[grid]);
        const auto there = [&](int row, int column) { return !is_void(rest.H_at_post_m(row, column)); };
        const auto at = [&](int row, int column) { return post_ecef(rest, row, column, 1.0).m - eye; };
        for (int row = 0; row + 1 < rest.grid.rows(); ++row) {
            for (int column = 0; column + 1 < rest.grid.columns(); ++column) {
                for (const bool west : {true, false}) {
                    const CellCorners corners = cell_corners(cell_diagonal(rest, row, column), west);
                    if (!std::ranges::all_of(corners, [&](const std::array<int, 2>& corner) {
                            return there(row + corner[0], column + corner[1]);
                        }))
                        continue;
                    all.push_back({at(row + corners[0][0], column + corners[0][1]),
                                   at(row + corners[1][0], column + corners[1][1]),
                                   at(row + corners[2][0], column + corners[2][1])});
                }
            }
        }
    }
    for (const SeamPiece& piece : seam.pieces)
        all.push_back(
            {piece.corners[0].at.m - eye, piece.corners[1].at.m - eye, piece.corners[2].at.m - eye});
    for (const SeamSkirt& skirt : seam.skirts) {
        all.push_back({skirt.top[0].at.m - eye, skirt.foot[0].at.m - eye, skirt.foot[1].at.m - eye});
        all.push_back({skirt.top[0].at.m - eye, skirt.foot[1].at.m - eye, skirt.top[1].at.m - eye});
    }
    return all;
}

// At full resolution each pixel's depth is that of the nearest triangle along its ray, but at edges: there a
// pixel may show what its neighbour does.
TEST_P(GridsTogether, AreWhatBruteForceFinds) {
    constexpr unsigned seed = 82;
    constexpr int picture_side_px = 40;
    std::mt19937 random(seed);
    open(test::three_grids(90));
    std::size_t pixels = 0, off = 0, beyond = 0;
    for (int i = 0; i < 12; ++i) {
        Camera camera = camera_over_rim(random, picture_side_px, 1500.0);
        camera.attitude.pitch_deg = std::uniform_real_distribution<double>(-60.0, 5.0)(random);
        const std::vector<float> drawn = depths(camera, 0.0);
        const std::vector<test::NearTriangle> all = all_triangles(region_, cuts_, seam_, camera.eye_ecef().m);
        const std::vector<double> truth = test::nearest_triangles_m(all, camera);
        const auto agrees = [&](double depth_m, double true_m) {
            if (std::isinf(true_m) || std::isinf(depth_m)) return std::isinf(true_m) && std::isinf(depth_m);
            return std::abs(depth_m - true_m) <= 0.02 + 1.0e-3 * true_m;
        };
        for (int y = 0; y < picture_side_px; ++y) {
            for (int x = 0; x < picture_side_px; ++x, ++pixels) {
                const float depth = drawn[static_cast<std::size_t>(y * picture_side_px + x)];
                const double m = depth > 0.0F ? near_m_ / static_cast<double>(depth)
                                              : std::numeric_limits<double>::infinity();
                if (agrees(m, truth[static_cast<std::size_t>(y * picture_side_px + x)])) continue;
                ++off;
                bool near = false;
                double low = std::numeric_limits<double>::infinity(), high = 0.0;
                for (int v = std::max(0, y - 1); v <= std::min(picture_side_px - 1, y + 1); ++v) {
                    for (int u = std::max(0, x - 1); u <= std::min(picture_side_px - 1, x + 1); ++u) {
                        const double there = truth[static_cast<std::size_t>(v * picture_side_px + u)];
                        near = near || agrees(m, there);
                        low = std::min(low, there);
                        high = std::max(high, there);
                    }
                }
                // Between two neighbours: on a wall, or on ground that is seen at a flat angle.
                near = near || (m >= low && m <= high);
                if (!near && ++beyond <= 5)
                    std::printf("view %d, pixel %d, %d: drawn at %.3f m, truth %.3f m\n", i, x, y, m,
                                truth[static_cast<std::size_t>(y * picture_side_px + x)]);
            }
        }
    }
    std::printf("seed %u: %zu pixels, %zu not at the truth's depth, %zu of them at none around\n", seed,
                pixels, off, beyond);
    EXPECT_EQ(beyond, 0U);
    EXPECT_LE(off, pixels / 100);
}

// Each picture is as near to the truth of all three grids, with their steps, as tau says.
TEST_P(GridsTogether, AreWithinTauOfTheTruth) {
    constexpr unsigned seed = 83;
    constexpr int views = 24;
    std::mt19937 random(seed);
    open(test::three_grids(300));
    const auto grounds = RegionGround::of(region_, cuts_, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    DepthPainter painter(*gpu_, GetParam());
    std::size_t pixels = 0, between = 0, beyond = 0, other = 0;
    double worst_share = 0.0;
    for (int i = 0; i < views; ++i) {
        Camera camera = camera_over_rim(random, 64, 3000.0);
        camera.attitude.pitch_deg = std::uniform_real_distribution<double>(-80.0, -5.0)(random);
        const double taus[] = {0.0, 0.5, 1.0, 2.0, 4.0};
        DepthPictureOptions options;
        options.tau_px = taus[i % 5];
        const auto picture = painter.draw(*scene_, camera, plain_style(), options);
        ASSERT_TRUE(picture.ok()) << picture.error().line();
        const Sight sight = sight_from(camera.eye);
        const TruePicture truth((*grounds)->ground(), sight, camera, 2);
        const PictureErrors errors = picture_errors(truth, picture->points, picture->skylines(), 2);
        const double allowed_px = options.tau_px + errors.slack_px;
        worst_share = std::max(worst_share, errors.largest_px() / allowed_px);
        pixels += errors.ground.drawn;
        between += errors.ground.between;
        beyond += errors.ground.beyond_data;
        other += errors.seen.other;
        EXPECT_LE(errors.largest_px(), allowed_px)
            << "view " << i << ", tau " << options.tau_px << ": displacement "
            << errors.ground.summary_displacement_px.largest << ", surface "
            << errors.ground.summary_surface_px.largest << ", seen " << errors.seen.summary_px.largest
            << ", skyline " << errors.skyline.summary_px.largest << "; eye " << camera.eye.lat_deg << ", "
            << camera.eye.lon_deg << ", h " << camera.eye.h_m;
    }
    std::printf(
        "seed %u: %d views, %zu pixels of ground, %zu on steps, %zu without true ground, %zu across an edge; "
        "largest error %.2f of what is allowed\n",
        seed, views, pixels, between, beyond, other, worst_share);
    EXPECT_GT(between, 100U);
    EXPECT_EQ(beyond, 0U);
}

INSTANTIATE_TEST_SUITE_P(Paths, GridsTogether, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
