// One trade's measurements: views drawn with all settings and held against the oracle, predictions beside.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/accuracy/verification.h"
#include "apps/drawing/region_scene.h"
#include "apps/options/options.h"
#include "apps/trade/trade_report.h"
#include "apps/trade/trade_settings.h"
#include "apps/view/accuracy.h"
#include "render/frame/depth_picture.h"

namespace oro {

// All that stays the same while views and settings change.
class Trade {
  public:
    // view: what does not change (exaggeration, size); its settings are not looked at. All outlive the trade.
    Trade(const View& view, const Region& region, const Gpu& gpu, RasterPath path,
          const gpu::FrameStyle& style, int repeats, const MemoryOptions& memory = {})
        : view_(view),
          region_(region),
          gpu_(gpu),
          style_(style),
          repeats_(repeats),
          memory_(memory),
          painter_(gpu, path, OcclusionUse::on),
          cases_(trade_cases(view, region)) {}

    // What each view is drawn with, in that order; trade_cases() where nobody says.
    void set_cases(std::vector<TradeCase> cases) { cases_ = std::move(cases); }
    // Reads the truth. Errors: damage in a baked region; nothing to draw.
    Result<void> prepare();
    [[nodiscard]] const TrueGround& ground() const { return truth_->ground(); }
    [[nodiscard]] RegionPagesList pages() const { return pointers_to(pages_); }
    // Adds a view's shots and effects to the report. camera: the true eye. `pictures`: put pictures of it in,
    // too. Errors: those of the device; terrain that it cannot hold.
    Result<void> measure(const Camera& camera, const std::string& name, bool pictures, TradeReport& report);

  private:
    [[nodiscard]] Camera camera_of(const Camera& camera, const TradeCase& one) const;
    [[nodiscard]] MemoryOptions share_of_memory() const;
    Result<Scene*> scene_of(const TradeCase& one);
    Result<TradeShot> shoot(const TradeCase& one, const Camera& camera, const TruePicture& truth,
                            Verification& drawn);
    void forget_frames(Scene& scene);
    Result<void> take_costs(Scene& scene, const Camera& from, DepthPictureOptions drawing, TradeShot& shot);
    Result<TradeEffect> predicted(const TradeCase& one, const EffectPrediction& prediction) const;

    const View& view_;
    const Region& region_;
    const Gpu& gpu_;
    const gpu::FrameStyle& style_;
    int repeats_;
    MemoryOptions memory_;
    DepthPainter painter_;
    std::vector<TradeCase> cases_;
    std::optional<Region> without_geoid_;
    std::unique_ptr<TrueScene> truth_;
    GridPages pages_;  // for predictions
    EarthParameters world_;
    std::map<std::tuple<bool, HeightStorage, bool>, Scene> scenes_;  // geoid, heights, clusters
};

}  // namespace oro
