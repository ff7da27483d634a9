// Views with all that a prediction of effects needs.
#pragma once

#include <memory>
#include <utility>

#include "core/base/parallel.h"
#include "core/effects/effects.h"
#include "tests/core/truth/world_field.h"

namespace oro::test {

// A prediction with all that must outlive it.
struct EffectScene {
    HeightField field;
    TrueSurface surface;
    std::unique_ptr<RegionPages> pages;
    EffectPrediction prediction;

    EffectScene(HeightField of, const Camera& camera, const EarthParameters& world = {})
        : field(std::move(of)),
          surface(field, 1.0, thread_count()),
          pages(pages_in_memory(field, 1.0, thread_count())),
          prediction(surface, *pages, camera, world, thread_count()) {}
    [[nodiscard]] EffectSize size(EffectKind kind, double tau_px = 1.0) const {
        return prediction.size(kind, tau_px).value().value();
    }
};

// One height on the equator, 0 to 1 degree east.
inline HeightField level_at(double H_m) {
    return test::world_field(1200.0, 120, 0, 241, 1201, [&](double, double) { return H_m; });
}
inline HeightField sea_level() {
    return level_at(0.0);
}

// N over the equator, 0 to 2 degrees east.
inline UndulationField undulation(double at_west_m, double per_deg_m) {
    UndulationField field;
    field.lat = {1.0, 0.0, 1, -1, 3};
    field.lon = {1.0, 0.0, 0, +1, 3};
    for (int i = 0; i < 9; ++i) field.N_m.push_back(static_cast<float>(at_west_m + per_deg_m * (i % 3)));
    return field;
}

// From 1,000 m, 45 degrees down, one pixel of 45 degrees: 1.207107 pixels to a tangent (0.5 / tan 22.5 deg),
// and the ground at 1,414.3 m (flat: 1,414.2 m). A height m is seen as m cos(45 deg) / 1,414.2 m = m / 2,000
// m.
inline Camera half_way_down() {
    Camera camera;
    camera.eye = {0.0, 0.1, 1000.0};
    camera.attitude = {90.0, -45.0, 0.0};
    return camera;
}

}  // namespace oro::test
