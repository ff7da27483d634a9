// A region's clusters that are drawn: its graph, and those of its clusters that are on the GPU.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/cluster_frame/streamed_choice.h"
#include "core/frame/frame_plan.h"
#include "core/frame/frame_tables.h"
#include "core/frame/visibility_feedback.h"
#include "render/clusters/cluster_store.h"
#include "render/clusters/cluster_stream.h"

namespace oro {

// Whether another plan is made only where it is better than the last one.
enum class NextPlan { if_better, anyway };

class ClusterScene {
  public:
    ClusterScene(ClusterScene&&) noexcept;
    ClusterScene& operator=(ClusterScene&&) = delete;  // a stream ends before what it reads
    ~ClusterScene();
    // Clusters may take `bytes` on the GPU, and at least what the coarsest take; groups that were read, and
    // those on their way, `main_bytes` of the processor's memory, or what a frame needs of them. Errors: out
    // of memory.
    static Result<ClusterScene> create(const Gpu& gpu, std::unique_ptr<RegionClusters> clusters,
                                       std::uint64_t bytes, std::uint64_t main_bytes = GroupCache::no_limit);

    // From now on the cut is that of a level of the graph, the same from everywhere; tau is for shading
    // alone.
    void keep_to_level(std::uint32_t level) { level_ = level; }
    // Whether a plan that does not wait, and lacks some of its cut, is drawn by the blocks of its pages (at
    // first false): a coarser cut may be the coarsest of all, for each place that it lacks takes what is
    // above it along. Not where clusters themselves are looked at, nor where a level is kept.
    void set_fallback_to_blocks(bool on) { falls_back_to_blocks_ = on; }

    // Puts the cut for an eye into the plan of its pages (plan_grid). Where it takes more than the GPU may
    // hold, it is a coarser one that does not, and the plan says so. model: on the ellipsoid. Errors: damage;
    // the device.
    //
    // This one waits for what of the cut is not on the GPU;
    Result<void> append_full_cut(GridPlan& plan, const Camera& camera, const Tile& tile, double tau_px,
                                 const WorldModel& model, const HorizonOccluder& occluder,
                                 const HeightQuantization& coding);
    // ... this one takes the finest cut of what is there, or blocks (set_fallback_to_blocks()), and lets the
    // background read the rest.
    Result<void> append_resident_cut(GridPlan& plan, const Camera& camera, const Tile& tile, double tau_px,
                                     const WorldModel& model, const HorizonOccluder& occluder,
                                     const HeightQuantization& coding);
    // What a frame of such a plan has shown: from the next plan on what is hidden is read last, and gives way
    // first. One that tells nothing makes that forgotten.
    void apply_feedback(const FrameFeedback& feedback);
    // The next plan is as the first one: what frames have shown is forgotten, and where the GPU is full, what
    // is there.
    void forget_frames();
    // Sends what is ready of what the last of these plans lacks: true when the next one will be better; or,
    // where another is made anyway, once anything has come: without a walk through the graph while there is
    // room. Does not wait for what is not ready. Errors: damage, the device.
    Result<bool> advance(NextPlan next = NextPlan::if_better);

    // Whether some more may come without an eviction.
    [[nodiscard]] bool has_capacity() const;

    [[nodiscard]] const ClusterStore& store() const { return store_; }
    // What groups take of the processor's memory: those that were read, without those on their way.
    [[nodiscard]] const GroupCache& groups() const { return clusters_->held(); }
    // The most clusters of a plan that there was no room for, of all plans so far.
    [[nodiscard]] std::size_t most_without_room() const { return most_without_room_; }

  private:
    ClusterScene(std::unique_ptr<RegionClusters> clusters, ClusterStore store, std::size_t most_on_the_way);
    [[nodiscard]] bool is_here(std::uint32_t cluster) const;
    [[nodiscard]] LackingCut lacking_cut() const;
    [[nodiscard]] bool is_drawn_by_blocks(const StreamedChoice& choice) const;
    Result<void> draw(const ClusterChoice& choice, const ClusterOffer& offer, const Camera& camera,
                      GridPlan& plan);
    Result<StreamedChoice> choose_here();
    void request(const StreamedChoice& choice);
    void request_rest(StreamedChoice choice);
    void keep(ClusterStream::Ready& ready);
    Result<StreamedChoice> send_wanted(const ClusterStream::Ready& ready);
    Result<void> send_ahead(const ClusterStream::Ready& ready);

    std::unique_ptr<RegionClusters> clusters_;
    ClusterStore store_;
    std::size_t most_on_the_way_;  // ClusterStream
    std::optional<std::uint32_t> level_;
    std::unique_ptr<ClusterStream> stream_;  // after clusters_: it ends before; null: nothing was streamed
    StreamedChoiceMemory choice_memory_;
    KeptAngles angles_;
    std::vector<char> is_wanted_;  // of each cluster, while clusters are sent
    ShownClusters shown_;          // by the last frame that told
    // Of the last plan that did not wait: its eye, what it draws, and whether that is all of the cut.
    std::optional<ClusterView> view_;
    std::vector<std::uint32_t> drawn_;
    bool is_whole_{}, has_room_{};
    bool falls_back_to_blocks_{false};
    std::size_t most_without_room_{};
};

}  // namespace oro
