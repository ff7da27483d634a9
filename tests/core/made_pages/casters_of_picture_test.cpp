// Must hold: what casts shadows into a picture is followed on the same levels by pages of made terrain that
// are for that picture and its light as by pages that are for any.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>

#include "core/frame/casters.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "tests/core/made_pages/made_ground.h"

namespace oro {
namespace {

// The casters of a picture, and which of their nodes light meets, by the rule of shaders/cast/shadow.glsl.
class Casters {
  public:
    Casters(const RegionPages& pages, const HeightField& field, const FrameView& view,
            const ShadowRequest& light)
        : pages_(pages), field_(field) {
        const Residency all = [](const PageIndex&) -> std::uint64_t { return 16; };
        auto plan = plan_grid(pages, all, view);
        EXPECT_TRUE(plan.ok());
        EXPECT_TRUE(plan_casters(pages, all, view, light, *region_top_m(pages), *plan).ok());
        for (const gpu::CasterPage& page : plan->casters.pages)
            held_.insert(
                {static_cast<int>(page.level), static_cast<int>(page.row), static_cast<int>(page.column)});
        shown_ = plan->pages.size();
        error_per_m_ = static_cast<double>(plan->casters.frame.error_per_m);
    }
    [[nodiscard]] std::size_t pages() const { return held_.size(); }
    [[nodiscard]] std::size_t shown() const { return shown_; }
    [[nodiscard]] double error_per_m() const { return error_per_m_; }

    // The level that light is held against over a post, where it may be off by so much: the coarsest that is
    // good enough. Nothing where all that the first level that says so stands for is lower than the light.
    std::optional<int> level_at(int row, int column, double error_m, double light_h_m) {
        int level = pages_.levels() - 1;
        while (level > 0 && !held_.contains(page_at(level, row, column))) --level;
        for (;; --level) {
            const gpu::MeshletBounds& node = node_at(level, row, column);
            if (highest_m(level, row, column) + static_cast<double>(node.error_m) < light_h_m)
                return std::nullopt;
            if (static_cast<double>(node.error_m) <= error_m || level == 0 ||
                !held_.contains(page_at(level - 1, row, column)))
                return level;
        }
    }

  private:
    using Key = std::array<int, 3>;
    static Key page_at(int level, int row, int column) {
        return {level, row >> (level + 7), column >> (level + 7)};
    }
    const gpu::MeshletBounds& node_at(int level, int row, int column) {
        const Key key = page_at(level, row, column);
        auto& block = blocks_[key];
        if (!block) {
            block = std::make_unique<gpu::PageBlock>();
            EXPECT_TRUE(pages_.load({key[1], key[2], key[0]}, *block).ok());
        }
        return block->meshlets[(row >> (level + 3) & 15) * 16 + (column >> (level + 3) & 15)];
    }
    // Of a node's posts.
    double highest_m(int level, int row, int column) {
        const auto [known, is_new] =
            highest_m_.try_emplace(Key{level, row >> (level + 3), column >> (level + 3)}, -1.0e9);
        if (!is_new) return known->second;
        for (int i = 0; i <= 8; ++i)
            for (int j = 0; j <= 8; ++j) {
                const int r = std::min(((row >> (level + 3)) * 8 + i) << level, field_.grid.rows() - 1);
                const int c = std::min(((column >> (level + 3)) * 8 + j) << level, field_.grid.columns() - 1);
                known->second = std::max(known->second, static_cast<double>(field_.H_at_post_m(r, c)));
            }
        return known->second;
    }

    const RegionPages& pages_;
    const HeightField& field_;
    std::set<Key> held_;
    std::size_t shown_{};
    double error_per_m_{};
    std::map<Key, std::unique_ptr<gpu::PageBlock>> blocks_;
    std::map<Key, double> highest_m_;
};

FrameView view_with(const Geodetic& eye, double heading_deg, double pitch_deg) {
    Camera camera;
    camera.eye = eye;
    camera.attitude = {.heading_deg = heading_deg, .pitch_deg = pitch_deg};
    camera.vertical_fov_deg = 40.0;
    // Few pixels: so casters may be coarse.
    camera.width_px = 64;
    camera.height_px = 36;
    return {camera, Tile{.width_px = 64, .height_px = 36}, 1.0};
}
ShadowRequest sun_at(double azimuth_deg, double elevation_deg) {
    const double a = radians_from_deg(azimuth_deg).rad, e = radians_from_deg(elevation_deg).rad;
    return {glm::dvec3(std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)), false};
}

struct Followed {
    int places{}, otherwise{}, above_in_one{}, coarse{};
};
// Places on the way from what the picture shows towards the sun that are followed on another level.
Followed compare(Casters& own, Casters& any, const TrueGround& ground, const FrameView& view,
                 const ShadowRequest& light, std::mt19937& random) {
    const Oracle oracle(ground, sight_from(view.camera.eye));
    const PostGrid grid = grid_of(made_terrain_of_tests());
    const glm::dvec3 sun = ecef_from_enu(view.camera.eye.lat_deg, view.camera.eye.lon_deg) * *light.sun_enu;
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Followed followed;
    for (int pixel = 0; pixel < 400; ++pixel) {
        const auto hit = oracle.first_hit(
            view.camera.ecef_direction_at({64.0 * share(random), 36.0 * share(random)}), 1.0e6);
        if (!hit) continue;
        const glm::dvec3 from = ecef_from_geodetic(hit->point).m;
        const glm::dvec3 here = glm::transpose(ecef_from_enu(hit->point.lat_deg, hit->point.lon_deg)) * sun;
        const double error_m =
            any.error_per_m() * hit->distance_m * std::clamp(here.z / std::hypot(here.x, here.y), 0.02, 1.0);
        for (double t_m = 30.0; t_m < 60'000.0; t_m *= 1.15) {
            const Geodetic at = geodetic_from_ecef({from + t_m * sun});
            const PostNumber post = grid.post_at(at.lat_deg, at.lon_deg);
            const int row = static_cast<int>(post.row), column = static_cast<int>(post.column);
            if (at.h_m > 4000.0 || row < 0 || column < 0 || row >= grid.rows() - 1 ||
                column >= grid.columns() - 1)
                break;
            const auto of_own = own.level_at(row, column, error_m, at.h_m),
                       of_any = any.level_at(row, column, error_m, at.h_m);
            ++followed.places;
            // Bounds that are wider may ask for a look at what light is above of.
            followed.above_in_one += of_own && !of_any ? 1 : 0;
            followed.otherwise += of_any && of_own != of_any ? 1 : 0;
            followed.coarse += of_any && *of_any > 0 ? 1 : 0;
        }
    }
    return followed;
}

TEST(CastersOfPicture, AreFollowedOnTheLevelsOfPagesForAny) {
    constexpr unsigned seed = 53;
    std::mt19937 random(seed);
    const HeightField field = made_ground();
    const TrueSurface surface(field, 1.0, 1);
    const TrueGround ground(surface);
    const struct {
        Geodetic eye;
        double heading_deg, pitch_deg, azimuth_deg, elevation_deg;
    } pictures[] = {{{46.2, 8.8, 4500.0}, 0.0, -8.0, 200.0, 30.0},
                    {{46.9, 8.3, 3000.0}, 120.0, -4.0, 90.0, 6.0},
                    {{47.5, 9.4, 6000.0}, 230.0, -20.0, 315.0, 2.0}};
    int coarse = 0;
    for (const auto& one : pictures) {
        const FrameView view = view_with(one.eye, one.heading_deg, one.pitch_deg);
        const ShadowRequest light = sun_at(one.azimuth_deg, one.elevation_deg);
        const HeightField fresh = made_ground();
        const auto pages = made_posts_of(fresh)->pages(fresh, {{view}, light});
        ASSERT_NE(pages->cast_map(), nullptr);
        Casters own(*pages, field, view, light), any(pages_for_any(), field, view, light);
        const Followed followed = compare(own, any, ground, view, light, random);
        std::printf(
            "%d places, %d of them on coarser levels, %d looked at by bounds alone; %zu pages, %zu of "
            "pages for any; %zu and %zu with those that are drawn\n",
            followed.places, followed.coarse, followed.above_in_one, own.pages() - own.shown(),
            any.pages() - any.shown(), own.pages(), any.pages());
        EXPECT_EQ(followed.otherwise, 0) << "seed " << seed << ", sun " << one.elevation_deg;
        coarse += followed.coarse;
    }
    EXPECT_GT(coarse, 300);
}

// Pages without the light leave casters out: so the test above would see what is not measured.
TEST(CastersOfPicture, AreNotThoseOfPagesWithoutLight) {
    std::mt19937 random(53);
    const HeightField field = made_ground();
    const TrueSurface surface(field, 1.0, 1);
    const TrueGround ground(surface);
    const FrameView view = view_with({46.9, 8.3, 3000.0}, 120.0, -4.0);
    const ShadowRequest light = sun_at(90.0, 6.0);
    const auto pages = made_posts_of(field)->pages(field, {{view}, {}});
    Casters own(*pages, field, view, light), any(pages_for_any(), field, view, light);
    EXPECT_GT(compare(own, any, ground, view, light, random).otherwise, 10);
}

}  // namespace
}  // namespace oro
