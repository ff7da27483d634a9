// Clusters in GPU memory: as many slots as a budget allows, in a few large buffers, reached by device
// address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "core/base/result.h"
#include "render/device/buffer_cache.h"

namespace oro {

// The cache of clusters on the GPU. What was hidden when it was drawn last is evicted first, then what has
// not been used for longest.
class ClusterStore {
  public:
    // At most `bytes`, at least one slot; buffers are made when they are needed.
    ClusterStore(const Gpu& gpu, std::uint64_t bytes);

    // A cluster that is here.
    struct Held {
        std::uint64_t address;
        std::uint32_t counts;  // gpu::DrawnCluster
    };
    // Fills a cluster's block and gives its counts.
    using Fill = std::function<Result<std::uint32_t>(std::uint32_t cluster, gpu::ClusterBlock& block)>;

    // From here on clusters are used by the next frame. What is sent lands after all frames before.
    void begin_frame() { cache_.items().begin_frame(); }
    // Uploads those of a frame's clusters that are not here: no more than there are slots, with what the
    // frame uses already. All of them are used by it then. Begins no frame. Errors: those
    // of `fill`; the device, which may have memory for fewer slots.
    Result<void> hold(std::span<const std::uint32_t> clusters, const Fill& fill);

    [[nodiscard]] bool is_here(std::uint32_t cluster) const { return cache_.items().find(cluster) != none; }
    // One that is here is used by the frame.
    Held use(std::uint32_t cluster);
    // What a frame has told of one, which may be here: whether other ground hides it.
    void mark_occluded(std::uint32_t cluster, bool is_hidden);
    // A cluster on its way.
    struct Loaded {
        std::uint32_t cluster;
        std::uint32_t counts;
        const gpu::ClusterBlock* block;
    };
    // Uploads clusters until there is no slot that the frame does not use. Errors: the
    // device.
    Result<void> send(std::span<const Loaded> clusters);

    // No cluster is here any more. No frame is being drawn.
    void clear() { cache_.items().clear(); }

    [[nodiscard]] std::size_t size() const { return cache_.items().size(); }
    [[nodiscard]] std::size_t capacity() const { return cache_.capacity(); }
    [[nodiscard]] std::uint64_t bytes() const { return cache_.bytes(); }  // of the buffers
    [[nodiscard]] std::uint64_t bytes_sent() const { return cache_.bytes_uploaded(); }

  private:
    struct Counts {
        std::uint32_t counts{};  // Held::counts
    };
    // A cluster's rank is 0 where it is hidden, else 1.
    using Cache = BufferCache<std::uint32_t, Counts>;
    static constexpr Cache::Handle none = Cache::Items::none;
    // False where there is no slot.
    Result<bool> add(const Loaded& cluster);

    Cache cache_;
};

}  // namespace oro
