// A region that is being drawn: its pages, and those of them that are on the GPU.
#pragma once

#include <functional>
#include <memory>

#include "core/frame_plan.h"
#include "core/region_pages.h"
#include "render/page_store.h"

namespace oro {

// Told how far a long step is, 0..1.
using RenderProgress = std::function<void(double share)>;

class Scene {
  public:
    // At most gpu_memory_bytes of pages on the GPU; 0: half of what the device has, at most 2 GiB. Errors:
    // out of memory.
    static Result<Scene> create(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
                                std::uint64_t gpu_memory_bytes);

    // What a frame draws with the pages that are on the GPU now.
    Result<FramePlan> plan(const Camera& camera, const Tile& tile, double tau_px);
    // The same once all that tau asks for is there: reads, builds and sends it on `threads()` threads. Where
    // a frame needs more than the GPU may hold, `missing` names the rest.
    Result<FramePlan> settled_plan(const Camera& camera, const Tile& tile, double tau_px);

    [[nodiscard]] const RegionPages& pages() const { return *pages_; }
    [[nodiscard]] PageStore& store() { return store_; }
    [[nodiscard]] std::uint64_t bytes_sent() const { return bytes_sent_; }

  private:
    Scene(std::unique_ptr<RegionPages> pages, PageStore store)
        : pages_(std::move(pages)), store_(std::move(store)) {}
    Result<std::size_t> load(std::span<const PageIndex> wanted);

    std::unique_ptr<RegionPages> pages_;
    PageStore store_;
    Buffer undulation_;
    std::uint64_t bytes_sent_{};
};

}  // namespace oro
