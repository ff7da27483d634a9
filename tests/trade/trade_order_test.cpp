// Must hold: what a setting costs does not depend on what was measured before it.
#include <algorithm>
#include <map>

#include "apps/trade/trade_measurement.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class TradeOrder : public test::GpuTest {
  protected:
    TradeOrder() {
        region_.grids[0].field = test::rough_field(46.6, 8.2, 500, 600);
        view_.camera.width_px = 128;
        view_.camera.height_px = 72;
    }

    // The same of one setting in one view, whenever it is measured.
    struct Counts {
        std::uint64_t first, settled, bytes;
        bool operator==(const Counts&) const = default;
    };
    using CountsOfShots = std::map<std::pair<std::string, std::string>, Counts>;

    // What clearly differs in detail, heights and air: "full detail" and "survey" are drawn alike.
    static std::vector<TradeCase> some_cases() {
        std::vector<TradeCase> cases = trade_cases(false, false);
        std::erase_if(cases, [](const TradeCase& one) {
            const auto& key = one.key;
            return key.effect && key.effect != EffectKind::refraction && key.tau_px != 0.5 &&
                   key.tau_px != 4.0;
        });
        return cases;
    }

    CountsOfShots measured(RasterPath path, bool backwards, int repeats, const MemoryOptions& memory = {}) {
        Trade trade(view_, region_, *gpu_, path, style_, repeats, memory);
        std::vector<TradeCase> cases = some_cases();
        if (backwards) std::ranges::reverse(cases);
        trade.set_cases(cases);
        const auto prepared = trade.prepare();
        EXPECT_TRUE(prepared.ok());
        std::vector<std::pair<std::string, Camera>> views{{"near", view_from(100.0, 205.0, -4.0, trade)},
                                                          {"open", view_from(2500.0, 300.0, -20.0, trade)}};
        if (backwards) std::ranges::reverse(views);
        TradeReport report;
        for (const auto& [name, camera] : views) {
            const auto done = trade.measure(camera, name, false, report);
            EXPECT_TRUE(done.ok()) << done.error().line();
        }
        CountsOfShots counts;
        for (const TradeShot& shot : report.shots)
            counts[{shot.view, name_of(shot.setting)}] = {shot.first.triangles, shot.settled.triangles,
                                                          shot.bytes};
        EXPECT_EQ(counts.size(), 2 * cases.size());
        return counts;
    }

    void expect_same(const CountsOfShots& one, const CountsOfShots& other) {
        for (const auto& [of, counts] : one) {
            SCOPED_TRACE(of.first + ", " + of.second);
            EXPECT_EQ(counts.first, other.at(of).first);
            EXPECT_EQ(counts.settled, other.at(of).settled);
            EXPECT_EQ(counts.bytes, other.at(of).bytes);
        }
    }

    Camera view_from(double above_m, double heading_deg, double pitch_deg, const Trade& trade) const {
        Camera camera = view_.camera;
        camera.eye = {46.45, 8.45, *trade.ground().h_m(46.45, 8.45) + above_m};
        camera.attitude = {heading_deg, pitch_deg, 0.0};
        return camera;
    }

    Region region_{std::vector<RegionGrid>(1)};
    View view_;
    gpu::FrameStyle style_{};
};

TEST_F(TradeOrder, CountsAreThoseOfAnyOrderAndAnyRepeats) {
    for (const RasterPath path : {RasterPath::compute, RasterPath::mesh}) {
        SCOPED_TRACE(name_of(path));
        const CountsOfShots once = measured(path, false, 1), backwards = measured(path, true, 3);
        expect_same(once, backwards);
        // Drawn alike, so they cost alike, wherever they stand.
        EXPECT_EQ(once.at({"near", "full detail"}), once.at({"near", "survey"}));
        // What the last picture saw tells which ground is hidden better than what is near.
        const Counts& near = once.at({"near", "full detail"});
        EXPECT_GT(near.settled, 0U);
        EXPECT_LT(near.settled, near.first);
    }
}

// The GPU holds what either view needs, and not both.
TEST_F(TradeOrder, NorDoTheyDependOnWhatFillsTheMemory) {
    region_.grids[0].field = test::rough_field(46.7, 8.0, 1500, 1700);
    MemoryOptions little;
    little.gpu_memory_mb = 48;  // for three scenes
    expect_same(measured(RasterPath::compute, false, 1, little),
                measured(RasterPath::compute, true, 2, little));
}

}  // namespace
}  // namespace oro
