#include "apps/region_scene.h"

#include <algorithm>
#include <thread>

namespace oro {

Result<Scene> create_scene(const Gpu& gpu, const Region& region, double exaggeration,
                           const MemoryOptions& memory, const RenderProgress& progress) {
    const int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
    std::unique_ptr<RegionPages> pages = pages_in_memory(region.field, exaggeration, threads, progress);
    if (pages->facts().triangles == 0)
        return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    const auto bytes = static_cast<std::uint64_t>(memory.gpu_memory_mb.value_or(0)) * 1000000U;
    return Scene::create(gpu, std::move(pages), bytes);
}

}  // namespace oro
