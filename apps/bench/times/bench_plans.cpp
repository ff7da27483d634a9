#include "apps/bench/times/bench_plans.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "apps/bench/times/bench_region.h"
#include "apps/bench/times/bench_times.h"

namespace oro {
namespace {

// What draws by plans of one kind.
struct PlannedSide {
    Scene scene;
    FrameRenderer renderer;
};

Result<PlannedSide> side_of(const Gpu& gpu, RasterPath path, BenchOptions options, bool on_device) {
    options.plan_on_device = on_device;
    options.choose_on_device = options.choose_on_device && on_device;
    ORO_TRY(BenchRegion region, open_bench_region(options));
    ORO_TRY(Scene scene, scene_of(gpu, options, region));
    scene.require_fields(options.style);
    ORO_TRY(FrameRenderer renderer, renderer_for(gpu, path, options));
    return PlannedSide{std::move(scene), std::move(renderer)};
}

// What pixels show.
struct ShownPixels {
    std::vector<std::uint32_t> ids;
    std::vector<std::uint8_t> rgba;
};

Result<ShownPixels> pixels_of(PlannedSide& side, const Camera& camera, const BenchOptions& options) {
    const Tile tile{0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    ORO_TRY(FramePlan plan, settled_as_window(side.scene, camera, tile, options));
    ORO_CHECK(side.renderer.draw(std::move(plan), options.style, 0, 1, side.scene.drapes()));
    const auto width_px = static_cast<std::uint32_t>(camera.width_px);
    const auto height_px = static_cast<std::uint32_t>(camera.height_px);
    ShownPixels pixels;
    ORO_TRY(pixels.ids, side.renderer.read_ids(width_px, height_px));
    ORO_TRY(pixels.rgba, side.renderer.read_picture(width_px, height_px));
    return pixels;
}

}  // namespace

Result<void> compare_plans(const Gpu& gpu, RasterPath path, std::span<const RandomFlight> flights,
                           const BenchOptions& options) {
    ORO_TRY(PlannedSide processor, side_of(gpu, path, options, false));
    ORO_TRY(PlannedSide device, side_of(gpu, path, options, true));
    std::uint64_t eyes = 0, pixels = 0, differ = 0, colours_differ = 0;
    for (const RandomFlight& flight : flights)
        for (const Camera& camera : flight.cameras) {
            ORO_TRY(const ShownPixels expected, pixels_of(processor, camera, options));
            ORO_TRY(const ShownPixels shown, pixels_of(device, camera, options));
            ++eyes;
            pixels += shown.ids.size();
            for (std::size_t i = 0; i < shown.ids.size(); ++i) {
                differ += shown.ids[i] != expected.ids[i] ? 1 : 0;
                const bool same =
                    std::equal(&shown.rgba[4 * i], &shown.rgba[4 * i] + 4, &expected.rgba[4 * i]);
                colours_differ += same ? 0 : 1;
            }
        }
    std::printf(
        "%s: %llu eyes in motion, seed %llu: of %llu pixels %llu show another triangle, %llu another "
        "colour\n",
        name_of(path).c_str(), static_cast<unsigned long long>(eyes),
        static_cast<unsigned long long>(options.seed), static_cast<unsigned long long>(pixels),
        static_cast<unsigned long long>(differ), static_cast<unsigned long long>(colours_differ));
    return {};
}

}  // namespace oro
