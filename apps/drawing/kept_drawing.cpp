#include "apps/drawing/kept_drawing.h"

#include <utility>

namespace oro {
namespace {

struct KeptScene {
    std::string key;
    RegionScene scene;
};
struct KeptDrawing {
    bool keeps{};
    std::shared_ptr<const Gpu> gpu;  // ends after what points to it
    std::optional<KeptScene> scene;
};

KeptDrawing& kept_drawing() {
    static KeptDrawing kept;
    return kept;
}

std::string number_text(const std::optional<int>& number) {
    return number ? std::to_string(*number) : "-";
}

}  // namespace

void keep_drawing() {
    kept_drawing().keeps = true;
}

bool keeps_drawing() {
    return kept_drawing().keeps;
}

void keep_no_scene() {
    kept_drawing().scene.reset();
}

void keep_no_drawing() {
    keep_no_scene();
    kept_drawing().gpu.reset();
    kept_drawing().keeps = false;
}

Result<std::shared_ptr<const Gpu>> gpu_to_draw_with() {
    KeptDrawing& kept = kept_drawing();
    if (kept.gpu) return kept.gpu;
    ORO_TRY(std::unique_ptr<Gpu> made, Gpu::create(gpu_options_from_environment()));
    std::shared_ptr<const Gpu> gpu(std::move(made));
    if (kept.keeps) kept.gpu = gpu;
    return gpu;
}

std::string scene_key(const View& view, const MemoryOptions& memory, bool means, bool clusters) {
    View same = view;
    same.camera = Camera{};
    same.map.reset();
    same.sun.reset();
    same.legend = false;
    same.time_utc_s = 0;
    same.tells_paths = true;
    if (same.fingerprints) same.fingerprints->style = same.fingerprints->pixels = std::nullopt;
    return view_to_json(same, false) + (view.map ? " map" : "") + (means ? " means" : "") +
           (clusters ? " clusters" : "") + " grid " + std::to_string(view.first_grid) + " memory " +
           number_text(memory.gpu_memory_mb) + " " + number_text(memory.memory_mb);
}

std::optional<RegionScene> take_kept_scene(const std::string& key) {
    std::optional<KeptScene> last = std::exchange(kept_drawing().scene, std::nullopt);
    if (!last || last->key != key) return std::nullopt;
    last->scene.scene.forget_frames();
    return std::move(last->scene);
}

void leave_scene(const std::string& key, RegionScene scene) {
    if (kept_drawing().keeps) kept_drawing().scene.emplace(KeptScene{key, std::move(scene)});
}

}  // namespace oro
