// Must hold: no background shines through made terrain, nor through ground that is invented between its
// posts, from any eye.
#include <algorithm>
#include <cstdio>
#include <random>
#include <string>

#include "core/terrain/ground.h"
#include "geo/opening/open_region.h"
#include "geo/refined/refined_region.h"
#include "geo/together/cut_regions.h"
#include "tests/scenes/scene_of_grids.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/drawn_scene.h"

namespace oro {
namespace {

class CracksOfMade : public test::GpuTest {
  protected:
    static Region made_region_of(const std::string& words) {
        RegionRequest request;
        request.paths = {words};
        auto region = open_region(request);
        EXPECT_TRUE(region.ok()) << region.error().line();
        return std::move(region).value();
    }
    // Pictures with background in them, of so many eyes; a third of them near a place, if there is one.
    void look(const std::string& name, const Region& region, Scene scene, int cameras,
              const DetailRequest* near) {
        constexpr unsigned seed = 20261129;
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        const HeightField& field = region.grids[0].field;
        std::size_t ground = 0;
        for (int i = 0; i < cameras; ++i) {
            Camera camera = test::random_camera(random, field);
            if (near != nullptr && i % 3 > 0) {
                camera.eye.lat_deg = near->lat_deg + (unit(random) - 0.5) * 0.02;
                camera.eye.lon_deg = near->lon_deg + (unit(random) - 0.5) * 0.03;
                camera.eye.h_m = ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0) +
                                 60.0 + 500.0 * unit(random);
            }
            const std::vector<std::uint32_t> ids = drawn(scene, camera, i % 5 == 0 ? 4.0 : 1.0);
            ground += ids.size() - static_cast<std::size_t>(std::count(ids.begin(), ids.end(), 0U));
            const int hole = test::pixel_of_a_hole(camera, ids);
            if (hole < 0) continue;
            ++holes_;
            std::printf(
                "%s, camera %d: background at pixel %d,%d; eye %.7f,%.7f h %.2f, heading %.2f pitch %.2f "
                "roll %.2f fov %.2f\n",
                name.c_str(), i, hole % test::crack_side_px, hole / test::crack_side_px, camera.eye.lat_deg,
                camera.eye.lon_deg, camera.eye.h_m, camera.attitude.heading_deg, camera.attitude.pitch_deg,
                camera.attitude.roll_deg, camera.vertical_fov_deg);
        }
        std::printf("%s, seed %u: %d cameras, %zu pixels of ground, pictures with background so far: %d\n",
                    name.c_str(), seed, cameras, ground, holes_);
        EXPECT_GT(ground, static_cast<std::size_t>(cameras) * 1000U) << name;
    }
    void look_over(const std::string& words, int cameras) {
        const Region region = made_region_of(words);
        look(words, region, test::scene_of_pages(*gpu_, pages_in_memory(region.grids[0].field, 1.0, 2)),
             cameras, nullptr);
    }
    // Four halvings of the way from post to post, some 700 m to each side.
    void look_over_detail(const std::string& words, double lat_deg, double lon_deg, int cameras) {
        Region region = made_region_of(words);
        const DetailRequest request{4, lat_deg, lon_deg, 700.0};
        const auto added = add_detail(region, request, nullptr);
        ASSERT_TRUE(added.ok()) << added.error().line();
        ASSERT_EQ(region.grids.size(), 2U);
        const auto cuts = cut_regions(region);
        ASSERT_TRUE(cuts.ok()) << cuts.error().line();
        const Seam seam = seam_between(region, *cuts, 1.0);
        look(words + " with detail", region, test::scene_of_grids(*gpu_, region, *cuts, seam), cameras,
             &request);
    }

    // cameras: of all together, nearly.
    void look_over_all(int cameras) {
        look_over("made:fbm?seed=7&octaves=12&H=-200:4000&spacing=3s&box=8,46,8.4,46.4", cameras / 4);
        look_over("made:ridged?seed=3&octaves=12&H=0:3000&spacing=3s&box=179.8,-16.2,-179.8,-15.9",
                  cameras / 8);
        look_over("made:fbm?seed=5&octaves=14&H=0:3000&spacing=5min&box=-180,80,180,90", cameras / 8);
        look_over("made:step?H=0:900&azimuth=30&spacing=3s&box=8,46,8.3,46.3", cameras / 16);
        look_over("made:checker?H=0:40&spacing=3s&box=8,46,8.2,46.2", cameras / 16);
        look_over("made:sphere?H=0:900&radius=9000&spacing=3s&box=8,46,8.3,46.3", cameras / 8);
        look_over_detail("made:ridged?seed=9&octaves=14&H=-800:3600&spacing=3s&box=8,46,8.2,46.2", 46.1, 8.1,
                         cameras / 4);
    }

    int holes_{};

  private:
    std::vector<std::uint32_t> drawn(Scene& scene, const Camera& camera, double tau_px) {
        if (!renderer_) {
            FrameRendererOptions options;
            options.extent = {test::crack_side_px, test::crack_side_px};
            options.path = RasterPath::compute;
            options.keep_depths = true;
            renderer_.emplace(test::made_renderer(*gpu_, options));
        }
        auto plan = scene.settled_plan({camera, test::whole_picture(camera), tau_px});
        EXPECT_TRUE(plan.ok()) << plan.error().line();
        const auto report = renderer_->draw(std::move(plan).value(), {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        auto ids = renderer_->read_ids(test::crack_side_px, test::crack_side_px);
        EXPECT_TRUE(ids.ok()) << ids.error().line();
        return std::move(ids).value();
    }
    std::optional<FrameRenderer> renderer_;
};

// The first of the long part's, over smaller ground.
TEST_F(CracksOfMade, NoneAtSomeCameras) {
    look_over("made:fbm?seed=7&octaves=12&H=-200:4000&spacing=3s&box=8,46,8.15,46.15", 20);
    look_over_detail("made:ridged?seed=9&octaves=14&H=-800:3600&spacing=3s&box=8.05,46.05,8.15,46.15", 46.1,
                     8.1, 20);
    EXPECT_EQ(holes_, 0);
}
// 10,000 take OROGRAPH_TEST_CAMERAS=10000.
TEST_F(CracksOfMade, NoneAtManyCameras) {
    look_over_all(test::asked_count("OROGRAPH_TEST_CAMERAS", 1000));
    EXPECT_EQ(holes_, 0);
}

}  // namespace
}  // namespace oro
