// Must hold: what plan predicts is never exceeded, and a tolerance is kept by the bundle that was chosen for
// it.
#include <algorithm>
#include <cstdio>
#include <map>

#include "apps/drawing/region_scene.h"
#include "apps/trade/trade_measurement.h"
#include "core/base/parallel.h"
#include "core/truth/view_set.h"
#include "geo/opening/open_region.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/real_views.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

constexpr int width_px = 256, height_px = 144;
constexpr std::uint64_t seed = test::real_view_seed;
constexpr double tolerance_px = 1.0;

// What came of one effect over all views.
struct Held {
    int views{}, broken{}, loose{};
    double predicted_px{}, measured_px{}, least_ratio{1e300}, most_ratio{};
};

class TradeOfViews : public test::GpuTest {
  protected:
    void look(const char* name, const Region& region, int views) {
        View view;
        view.camera.width_px = width_px;
        view.camera.height_px = height_px;
        const gpu::FrameStyle style{};
        Trade trade(view, region, *gpu_, RasterPath::compute, style, 1);
        ASSERT_TRUE(trade.prepare().ok());
        for (const Camera& camera : made_cameras(seed, trade.ground(), views, width_px, height_px)) {
            TradeReport report;
            const auto measured = trade.measure(camera, name, false, report);
            ASSERT_TRUE(measured.ok()) << measured.error().line();
            for (const TradeEffect& effect : report.effects) {
                for (const TradeShot& shot : report.shots) {
                    if (shot.setting == effect.key)
                        what_ = "displacement " + std::to_string(shot.displacement_px.largest) +
                                ", surface " + std::to_string(shot.surface_px.largest) + ", seen " +
                                std::to_string(shot.seen_px.largest) + ", skyline " +
                                std::to_string(shot.skyline_px.largest);
                }
                add(effect, camera);
            }
            view.camera = camera;
            const auto choice = choose_accuracy(view, region, trade.ground(), trade.pages(), tolerance_px);
            ASSERT_TRUE(choice.ok()) << choice.error().line();
            add(*choice, report);
        }
    }

    void add(const TradeEffect& effect, const Camera& camera) {
        if (!effect.measured_px) return;
        Held& held = held_[name_of(effect.key)];
        ++held.views;
        held.predicted_px = std::max(held.predicted_px, effect.predicted_px);
        held.measured_px = std::max(held.measured_px, *effect.measured_px);
        if (*effect.measured_px > 0.0) {
            const double ratio = effect.predicted_px / *effect.measured_px;
            held.least_ratio = std::min(held.least_ratio, ratio);
            // Below a tenth of a pixel a bound says all that anybody asks.
            if (effect.predicted_px > 0.1) held.most_ratio = std::max(held.most_ratio, ratio);
            if (effect.predicted_px > 0.1 && ratio > 10.0) ++held.loose;
        }
        if (*effect.measured_px <= effect.predicted_px && *effect.measured_m <= effect.predicted_m) return;
        ++held.broken;
        ADD_FAILURE() << effect.view << ", " << name_of(effect.key) << ": " << *effect.measured_px << " px ("
                      << what_ << "), predicted " << effect.predicted_px << "; " << *effect.measured_m
                      << " m, predicted " << effect.predicted_m << "; eye " << camera.eye.lat_deg << ","
                      << camera.eye.lon_deg << " h " << camera.eye.h_m << " heading "
                      << camera.attitude.heading_deg << " pitch " << camera.attitude.pitch_deg << " fov "
                      << camera.vertical_fov_deg;
    }

    void add(const AccuracyChoice& choice, const TradeReport& report) {
        ++chosen_[choice.bundle.name];
        const TradeKey bundle{{}, {}, choice.bundle.kind};
        const auto found = std::find_if(report.effects.begin(), report.effects.end(),
                                        [&](const TradeEffect& one) { return one.key == bundle; });
        ASSERT_NE(found, report.effects.end());
        EXPECT_NEAR(found->predicted_px, choice.predicted_px, 1.0e-9) << "plan and trade predict alike";
        if (!choice.holds) return;
        worst_chosen_px_ = std::max(worst_chosen_px_, *found->measured_px);
        EXPECT_LE(*found->measured_px, tolerance_px) << choice.bundle.name;
    }

    void tell(const char* of, int views) {
        std::printf("%s, seed %llu, %d views of %d x %d px\n%-34s %6s %12s %12s %9s %9s %6s %6s\n", of,
                    static_cast<unsigned long long>(seed), views, width_px, height_px, "effect", "views",
                    "predicted px", "measured px", "ratio >=", "ratio <=", "broken", "> 10 x");
        for (const auto& [effect, held] : held_)
            std::printf("%-34s %6d %12.4g %12.4g %9.2f %9.2f %6d %6d\n", effect.c_str(), held.views,
                        held.predicted_px, held.measured_px, held.least_ratio, held.most_ratio, held.broken,
                        held.loose);
        std::printf(
            "tolerance %g px: %d draft, %d balanced, %d survey; largest measured error of what was chosen "
            "%.3g px\n",
            tolerance_px, chosen_["draft"], chosen_["balanced"], chosen_["survey"], worst_chosen_px_);
        EXPECT_GE(2 * (chosen_["draft"] + chosen_["balanced"]), views)
            << "cheaper than survey in half of the views";
    }

    // A folder of real data.
    void look_over(const char* folder, const char* tiles, int views) {
        RegionRequest request;
        request.paths = {test::real_data(folder)->string()};
        request.box = *parse_tile_range(tiles);
        const auto region = open_region(request);
        ASSERT_TRUE(region.ok()) << region.error().line();
        look(folder, *region, views);
    }

    std::map<std::string, Held> held_;
    std::map<std::string, int> chosen_;
    std::string what_;
    double worst_chosen_px_{};
};

TEST_F(TradeOfViews, PredictionsHoldOnMadeTerrain) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::rough_field(46.6, 8.2, 400, 500);
    look("made terrain", region, 3);
    tell("made terrain", 3);
}

// Each eye over one of three grids, which lie over each other with steps between them.
TEST_F(TradeOfViews, PredictionsHoldOnSeveralGrids) {
    look("three grids", test::three_grids(400), 3);
    tell("three grids", 3);
}

TEST_F(TradeOfViews, PredictionsHoldOnRealTerrain) {
    const int views = test::view_count(6);
    for (std::size_t i = 0; i < test::real_regions.size(); ++i) {
        const test::RealRegion& region = test::real_regions[i];
        if (!test::real_data(region.folder)) GTEST_SKIP() << "needs " << region.folder;
        look_over(region.folder, region.tiles, test::views_of(i, views));
    }
    tell("alps, himalaya, poland", views);
}

}  // namespace
}  // namespace oro
