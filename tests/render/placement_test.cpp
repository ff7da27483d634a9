// Must hold: a post lands within 1 mm of GeographicLib's answer on pages up to 4 km, 2 mm up to 12 km, as the
// mesh shader itself places it on the GPU.
#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "core/frame/placement_promise.h"
#include "render/frame/picture_renderer.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/made_terrain.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

constexpr unsigned seed = 20261121;

struct Placed {
    double worst_m{};
    std::size_t posts{};
    double of_promise{};  // the largest share of 1 mm and 3.2e-7 of the distance
};

class PlacementOnGpu : public test::GpuTest {
  protected:
    // One page of posts at a latitude with heights around h0, drawn from above; the largest error of its
    // posts.
    Placed place_page(double lat_deg, double lon_deg, double page_m, double h0_m, std::mt19937& random) {
        const double m_per_deg = meridian_radius_m(lat_deg) * std::numbers::pi / 180.0;
        // Round a pole a page reaches as far beyond as before it: its rows stay within half its width of the
        // pole.
        const double to_pole_m = (90.0 - std::abs(lat_deg)) * m_per_deg;
        const double rows_m = to_pole_m > 0.5 * page_m ? page_m : 0.5 * page_m;
        const double lat_spacing = rows_m / 128.0 / m_per_deg;
        const double around_m =
            std::max(1.0, prime_vertical_radius_m(lat_deg) * std::cos(radians_from_deg(lat_deg).rad));
        const double lon_spacing =
            std::min(page_m / 128.0 / (around_m * std::numbers::pi / 180.0), 350.0 / 128.0);
        std::uniform_real_distribution<float> height(static_cast<float>(h0_m) - 2000.0F,
                                                     static_cast<float>(h0_m) + 2000.0F);
        HeightField field;
        const double north = std::clamp(lat_deg + 64.0 * lat_spacing, -90.0 + 128.0 * lat_spacing, 90.0);
        field.grid.lat = {1.0 / lat_spacing, north, 0, -1, 129};
        field.grid.lon = {1.0 / lon_spacing, lon_deg - 64.0 * lon_spacing, 0, 1, 129};
        for (int row = 0; row < 129; ++row) {
            // The posts of a pole's row are one place, and so have one height.
            const bool at_pole = std::abs(field.grid.lat.at_deg(row)) == 90.0;
            const float one = height(random);
            for (int column = 0; column < 129; ++column) field.H_m.push_back(at_pole ? one : height(random));
        }

        // In the page's middle: posts are placed relative to the eye.
        return draw_page(field,
                         {field.grid.lat.at_deg(64), normalised_lon_deg(field.grid.lon.at_deg(64)), h0_m});
    }

    // Posts of a field of one page as an eye over it has them.
    Placed draw_page(const HeightField& field, const Geodetic& eye) {
        auto scene = Scene::create(*gpu_, pages_in_memory(field, 1.0, 2));
        EXPECT_TRUE(scene.ok()) << scene.error().line();
        FrameRendererOptions options;
        options.extent = {64, 64};
        options.record_positions = true;
        auto renderer = FrameRenderer::create(*gpu_, options);
        EXPECT_TRUE(renderer.ok()) << renderer.error().line();
        Camera camera;
        camera.eye = eye;
        camera.vertical_fov_deg = 110.0;
        camera.width_px = camera.height_px = 64;
        auto plan = scene->settled_plan({camera, {0, 0, 64, 64, {0.5, 0.5}}, 0.0});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        EXPECT_EQ(plan->grids[0].pages.size(), 1U);
        for (gpu::FramePage& page : plan->grids[0].pages)
            page.cull &= gpu::places_from_plane;  // every meshlet is to be placed
        auto drawn = renderer->draw(*plan, {});
        EXPECT_TRUE(drawn.ok()) << drawn.error().line();
        EXPECT_EQ(drawn->counts.meshlets_drawn, 256U);
        return worst_error(field, camera, renderer->recorded());
    }

    // The same of a page whose posts lie on a net.
    Placed place_net_page(const test::PlaneOfPosts& plane, double h0_m, std::mt19937& random) {
        std::uniform_real_distribution<float> height(static_cast<float>(h0_m) - 2000.0F,
                                                     static_cast<float>(h0_m) + 2000.0F);
        const HeightField field = test::net_field(
            plane, [&](double, double) { return height(random); }, 47.25F);
        const PostPlace middle = field.grid.place_at(64, 64);
        return draw_page(field, {middle.lat_deg, middle.lon_deg, h0_m});
    }

    static Placed worst_error(const HeightField& field, const Camera& camera,
                              const std::vector<gpu::vec3>& recorded) {
        const auto& earth = GeographicLib::Geocentric::WGS84();
        const SineCosine lon = sine_cosine_deg(camera.eye.lon_deg);
        const glm::dmat3 ecef_from_eye(lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0);
        Placed placed;
        for (int row = 0; row < 129; ++row) {
            for (int column = 0; column < 129; ++column) {
                glm::dvec3 truth;
                const PostPlace place =
                    field.grid.net ? field.grid.net->place_at(row, column)
                                   : PostPlace{field.grid.lat.at_deg(row), field.grid.lon.at_deg(column)};
                earth.Forward(place.lat_deg, place.lon_deg, field.h_at_post_m(row, column), truth.x, truth.y,
                              truth.z);
                const glm::dvec3 from_gpu(recorded[static_cast<std::size_t>(row * 129 + column)]);
                ++placed.posts;
                const double error = glm::length(camera.eye_ecef().m + ecef_from_eye * from_gpu - truth);
                placed.worst_m = std::max(placed.worst_m, error);
                const double away_m = glm::length(truth - camera.eye_ecef().m);
                placed.of_promise = std::max(placed.of_promise, error / (placement_near_m + 3.2e-7 * away_m));
            }
        }
        return placed;
    }
};

TEST_F(PlacementOnGpu, AgreesWithGeographicLibAtAllLatitudes) {
    std::mt19937 random(seed);
    std::printf("placement on %s against GeographicLib (seed %u)\n", gpu_->report().name.c_str(), seed);
    std::printf("%10s %8s %8s %14s\n", "latitude", "page", "posts", "worst");
    std::size_t posts = 0;
    for (const double page_m : {placement_near_reach_m, 12000.0}) {
        const double bound_m = page_m <= placement_near_reach_m ? placement_near_m : 0.002;
        for (const double lat_deg : {-89.99, -71.3, -45.0, -12.0, 0.0, 23.4, 46.5, 60.0, 80.0, 89.5, 89.99}) {
            const double lon_deg = std::uniform_real_distribution<double>(-180.0, 180.0)(random);
            const double h0_m = std::uniform_real_distribution<double>(-9000.0, 7000.0)(random);
            const Placed placed = place_page(lat_deg, lon_deg, page_m, h0_m, random);
            posts += placed.posts;
            std::printf("%9.2f° %6.0f m %8zu %11.3f mm\n", lat_deg, page_m, placed.posts,
                        1e3 * placed.worst_m);
            EXPECT_LE(placed.worst_m, bound_m) << "at latitude " << lat_deg;
        }
    }
    EXPECT_GE(posts, 100000U);
}

// Posts that have places of their own: whole steps from the eye, rounded once.
TEST_F(PlacementOnGpu, OfNetsAgreesWithGeographicLib) {
    std::mt19937 random(seed);
    for (const double page_m : {placement_near_reach_m, 12000.0}) {
        for (const double lat_deg : {-90.0, -71.3, -33.0, 0.0, 46.5, 80.0, 89.99}) {
            const double lon_deg = std::uniform_real_distribution<double>(-180.0, 180.0)(random);
            const double h0_m = std::uniform_real_distribution<double>(-9000.0, 7000.0)(random);
            const double turn_deg = std::uniform_real_distribution<double>(-180.0, 180.0)(random);
            const Placed placed =
                place_net_page({129, 129, {lat_deg, lon_deg}, page_m / 128.0, turn_deg}, h0_m, random);
            std::printf("net at %6.2f°, %6.0f m, turned by %4.0f°: %zu posts, worst %.3f mm\n", lat_deg,
                        page_m, turn_deg, placed.posts, 1e3 * placed.worst_m);
            EXPECT_LE(placed.worst_m, page_m <= placement_near_reach_m ? placement_near_m : 0.003)
                << "at latitude " << lat_deg;
        }
    }
}

// One page of 4,500 km, whose places are told from a plane: within what is promised of far posts.
TEST_F(PlacementOnGpu, OfAContinentAgreesWithGeographicLib) {
    std::mt19937 random(seed);
    for (const double lat_deg : {-90.0, -25.0, 55.0}) {
        const Placed placed = place_net_page({129, 129, {lat_deg, 134.0}, 35000.0, 20.0}, 500.0, random);
        std::printf("continent at %6.2f°: %zu posts, worst %.3f m, %.2f of what is promised\n", lat_deg,
                    placed.posts, placed.worst_m, placed.of_promise);
        EXPECT_LE(placed.of_promise, 1.0) << "at latitude " << lat_deg;
    }
}

}  // namespace
}  // namespace oro
