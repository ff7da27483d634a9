// Clusters in GPU memory: as many slots as a budget allows, in a few large buffers, reached by device
// address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "render/device/resources.h"

namespace oro {

// What was hidden when it was drawn last makes room for what comes, then what has not been used for longest.
class ClusterStore {
  public:
    // At most `bytes`, at least one slot; buffers are made when they are needed.
    static Result<ClusterStore> create(const Gpu& gpu, std::uint64_t bytes);

    // A cluster that is here.
    struct Held {
        std::uint64_t address;
        std::uint32_t counts;  // gpu::DrawnCluster
    };
    // Fills a cluster's block and gives its counts.
    using Fill = std::function<Result<std::uint32_t>(std::uint32_t cluster, gpu::ClusterBlock& block)>;

    // From here on clusters count as used by another frame: those of earlier ones may make room.
    void begin_frame();
    // Sends those of a frame's clusters that are not here: no more than there are slots, with what the frame
    // uses already. All of them are used by it then. Begins no frame. Waits for the GPU. Errors: those of
    // `fill`; the device.
    Result<void> hold(std::span<const std::uint32_t> clusters, const Fill& fill);

    [[nodiscard]] bool is_here(std::uint32_t cluster) const;
    // One that is here is used by the frame.
    Held use(std::uint32_t cluster);
    // What a frame has told of one, which may be here: whether other ground hides it.
    void note_hidden(std::uint32_t cluster, bool is_hidden);
    // A cluster on its way.
    struct Loaded {
        std::uint32_t cluster;
        std::uint32_t counts;
        const gpu::ClusterBlock* block;
    };
    // Sends clusters until there is no slot that the frame does not use. Waits for the GPU. Errors: the
    // device.
    Result<void> send(std::span<const Loaded> clusters);

    // No cluster is here any more. No frame is being drawn.
    void forget_clusters();

    [[nodiscard]] std::size_t size() const { return held_; }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint64_t bytes() const;  // of the buffers
    [[nodiscard]] std::uint64_t bytes_sent() const { return sent_ * sizeof(gpu::ClusterBlock); }

  private:
    struct Slot {
        std::uint32_t cluster;
        std::uint32_t counts;
        std::uint64_t used;  // frame
        bool is_hidden;
    };
    explicit ClusterStore(const Gpu& gpu) : gpu_(&gpu) {}
    Result<std::size_t> free_slot();
    void forget(std::uint32_t cluster);
    Result<void> stage(const Loaded& cluster);
    Result<void> copy_staged();
    [[nodiscard]] std::uint64_t address(std::size_t slot) const;

    const Gpu* gpu_;
    Commands commands_;
    Buffer staging_;
    std::vector<Buffer> chunks_;
    std::size_t capacity_{};
    std::vector<Slot> slots_;           // those ever used
    std::vector<std::size_t> unused_;   // by the frame, those that make room first last
    std::vector<std::size_t> slot_of_;  // of each cluster ever asked for; no_slot where it is not here
    std::vector<std::size_t> staged_;   // slots of what is to be copied
    std::size_t held_{0};
    std::uint64_t frame_{0};
    std::uint64_t sent_{0};
};

}  // namespace oro
