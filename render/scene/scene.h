// A region that is being drawn: its pages, and those of them that are on the GPU.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/frame/plan_memory.h"
#include "core/frame/region_pages.h"
#include "core/frame/visibility_feedback.h"
#include "core/seam/cleared_map.h"
#include "render/clusters/cluster_scene.h"
#include "render/scene/device_choice.h"
#include "render/scene/drape_store.h"
#include "render/scene/page_store.h"

namespace oro {

// Told how far a long step is, 0..1.
using RenderProgress = std::function<void(double share)>;

// How much memory pages may take, bytes.
struct SceneMemory {
    std::uint64_t gpu{};   // pages on the GPU; 0: half of what the device has, at most 2 GiB
    std::uint64_t main{};  // pages on their way there; 0: 64 MB
    unsigned shares{1};    // scenes that share `main`
    // Memory on the GPU that others take from, too, in place of `gpu`; null: none do. Meshes take all that
    // they need of it.
    std::shared_ptr<MemoryBudget> shared{};
};
// What `gpu` stands for on a device, bytes, where 0 is as much as is reasonable there;
std::uint64_t gpu_bytes(const Gpu& gpu, std::uint64_t bytes);
// The same of `main`.
std::uint64_t main_bytes(std::uint64_t bytes);
// gpu_bytes() to be shared.
std::shared_ptr<MemoryBudget> page_budget(const Gpu& gpu, std::uint64_t bytes);

// How long the processor took for the parts of a plan, seconds.
struct PlanTimes {
    double pages_s{};     // pages chosen, with the tables that place their posts
    double clusters_s{};  // clusters chosen, with theirs
    double casters_s{};   // what casts shadows and opens the sky
    double growth_s{};    // tiles of trees
};

// The ground near meshes, and its cells on the GPU: made when a frame first asks for it.
class ClearedGround {
  public:
    struct Made {
        ClearedMap map;
        Buffer cells;
    };
    // Both outlive it.
    ClearedGround(const Gpu& gpu, const MeshCasters& casters) : gpu_(gpu), casters_(casters) {}
    // Errors: out of device memory.
    Result<const Made*> made();

  private:
    const Gpu& gpu_;
    const MeshCasters& casters_;
    std::optional<Made> made_;
};

// One grid that is being drawn: its pages, and those of them that are on the GPU.
class GridScene {
  public:
    // As Scene::create().
    static Result<GridScene> create(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
                                    const SceneMemory& memory, HeightStorage heights, bool means,
                                    HeightMaker maker);

    [[nodiscard]] const RegionPages& pages() const { return *pages_; }
    [[nodiscard]] PageStore& store() { return store_; }
    [[nodiscard]] const PageStore& store() const { return store_; }
    // Images over its ground; null: none.
    [[nodiscard]] DrapeStore* drape() const { return drape_.get(); }
    // Memory on the GPU that it shares with others; null: with none.
    [[nodiscard]] const std::shared_ptr<MemoryBudget>& shared_memory() const { return shared_memory_; }
    // What draws its ground in place of its pages' nodes.
    [[nodiscard]] const std::optional<ClusterScene>& clusters() const { return clusters_; }

  private:
    friend class Scene;
    GridScene(std::unique_ptr<RegionPages> pages, PageStore store)
        : pages_(std::move(pages)), store_(std::move(store)), memory_(*pages_), seen_(*pages_) {}
    // Number of pages that there was room for, of those that were ready; whether it was short for hidden ones
    // alone, or for those that show.
    struct Sent {
        std::size_t count{};
        bool hidden_left{}, shown_left{};
    };
    Result<Sent> send_ready(bool wait,
                            PageStore::Evictions evictions = PageStore::Evictions::of_unused);
    // Waits for all of them: false where there was no room.
    Result<bool> load_pages(std::span<const PageIndex> pages);
    Result<GridPlan> plan_of_pages(const FrameView& view);
    Result<void> add_casters(const FrameView& view, GridPlan& plan);
    Result<void> add_growth(const FrameView& view, GridPlan& plan);
    // Those of missing pages that may show.
    [[nodiscard]] std::vector<PageIndex> shown_of(std::span<const PageIndex> missing) const;
    [[nodiscard]] bool is_hidden(const PageIndex& page) const;
    enum class Clusters { that_are_here, waited_for };
    Result<void> add_clusters(const FrameView& view, Clusters clusters, GridPlan& plan);
    // A plan without what casts shadows, then with that; and both.
    Result<GridPlan> begun_plan(const FrameView& view, Clusters clusters);
    Result<void> end_plan(const FrameView& view, GridPlan& plan);
    // Whether the device may choose the pages of the next frame; a plan that leaves that to it, or nothing
    // where the view does not allow it.
    [[nodiscard]] bool can_leave_choice() const;
    [[nodiscard]] bool may_leave_choice() const;
    Result<std::optional<GridPlan>> plan_by_device(const FrameView& view);
    [[nodiscard]] std::vector<PageIndex> coarsest_pages() const;
    [[nodiscard]] bool has_coarsest_pages() const;
    Result<bool> advance_coarsest_pages();
    void set_missed(std::vector<PageIndex> missing, std::size_t hidden);
    [[nodiscard]] bool lacks_pages() const;
    [[nodiscard]] bool lacks_memory() const;
    Result<GridPlan> plan(const FrameView& view, Clusters clusters);
    Result<GridPlan> settled_plan(const FrameView& view);
    Result<bool> advance(NextPlan next);
    bool apply_feedback(const FrameFeedback& feedback);
    // gives_back: memory of pages, too.
    void forget_frames(bool gives_back);

    std::unique_ptr<RegionPages> pages_;
    std::unique_ptr<PageLoader> loader_;
    PageStore store_;
    std::unique_ptr<DrapeStore> drape_;
    Buffer undulation_;
    std::shared_ptr<ClearedGround> cleared_;  // near the meshes of the scene; null: there are none
    bool wants_cleared_{false};               // the style tells materials of the ground
    Buffer mesh_casters_;                     // nodes, then triangles; of a seam with meshes
    std::shared_ptr<MemoryBudget> shared_memory_;
    MemoryBudget::Share of_meshes_;  // what meshes take of it: all of them are there, or none is drawn
    Buffer plan_sources_;
    std::uint64_t number_{};  // GridPlan::heights
    PlanMemory memory_;
    std::optional<DeviceChoice> choice_;
    VisibilityFeedback seen_;
    std::vector<PageIndex> missed_;  // by the last plan
    std::set<PageIndex> hidden_;     // of those
    bool full_{false};               // of the last frame's pages
    bool full_for_hidden_{false};    // at least for those, if they spare what was shown lately,
    bool full_for_all_hidden_{false};  // ... and if they spare nothing but the frame's own
    bool has_trees_{false};          // whether plans have sites of trees,
    bool has_grass_{false};          // ... and of grass
    bool can_evict_hidden_{false};   // hidden pages of the last plan could, for missing ones
    bool leaves_choice_{true};       // Scene::leave_choice()
    bool left_choice_{false};        // the last plan did: nobody knows which pages its frame uses
    bool needs_plan_{false};         // of the processor, which says what pages its frame uses and lacks
    ShadowRequest cast_;
    double asked_means_px_{gpu::means_spacing_px}, means_spacing_px_{gpu::means_spacing_px};
    std::vector<ShadowReceiver> receivers_;  // shown by other grids of the frame
    std::optional<double> top_m_;            // of the region, once it was asked for
    std::optional<ClusterScene> clusters_;
    PlanTimes times_;  // of the last plan
};

// Keeps on the GPU what a camera needs of a region's grids, as fine as tau asks for, within a budget of
// memory.
//     ORO_TRY(Scene scene, Scene::create(*gpu, pages_in_memory(field, 1.0, thread_count())));
//     ORO_TRY(FramePlan plan, scene.settled_plan({camera, {0, 0, 320, 240, {0.5, 0.5}}, 1.0}));  // tau 1 px
class Scene {
  public:
    // A scene of one grid. heights: how they are kept on the GPU. means: for styles whose pixels are means of
    // the ground. maker: of heights where the pages have a made_ground(). Errors: out of memory; a file that
    // cannot be read.
    static Result<Scene> create(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
                                const SceneMemory& memory = {}, HeightStorage heights = HeightStorage::f32,
                                bool means = false, HeightMaker maker = HeightMaker::fastest);
    // Puts the grids of another scene behind its own, each with its own pages, memory and streaming.
    void add(Scene other);
    // Puts grids in the place of what is drawn between those of posts (RegionPages::has_posts()), or nothing.
    // No frame that shows what was there is under way.
    void replace_between(std::optional<Scene> other);

    // From the next plan on its ground is drawn by clusters, on the ellipsoid; pages are there for shading.
    // The scene has one grid: triangle ids are numbered by the clusters of one. Before plan_on_device().
    void draw_clusters(ClusterScene clusters);
    // ClusterScene::set_fallback_to_blocks(), where there are clusters.
    void set_fallback_to_blocks(bool on);

    // From the next plan on it also holds what a style needs of the terrain around (core/frame/casters.h):
    // for shadows of all its grids, on the ground of all. How open the sky is each grid's own terrain tells.
    void set_shadow_request(const ShadowRequest& request);
    // ... and squares of means that are at most so large on the screen (core/lod/ground_means.h), where it
    // has any; once the GPU has no room for them, as large as other styles take.
    void set_footprint_spacing(double spacing_px);
    // ... and the sites of trees around the eye (core/growth/growth_plan.h), on WGS84.
    void set_trees(bool on);
    // ... and those of grass (core/growth/meadow_plan.h), likewise.
    void set_grass(bool on);
    // All of these, as a style asks for them.
    void require_fields(const gpu::FrameStyle& style);
    // From the next plan on what the device can make of plans by itself is left to it, of each grid that has
    // neither clusters nor a net, and whose sources take no more than 64 MB of it. The frames are the same.
    // False where the device has no doubles (PlanPass::can_run()). Errors: the device.
    Result<bool> plan_on_device(const Gpu& gpu);
    // As plan_on_device(), and the device chooses the pages as well, of frames without shadows, trees, grass
    // and images, while all that comes finds room. What a plan says of missing pages is then that of a frame
    // before. The frames are the same. No frame is under way. most_bytes: that records of a grid's pages may
    // take; the records are made now, 264 bytes a page. Errors: as plan_on_device(); a file that cannot be
    // read.
    Result<bool> choose_on_device(const Gpu& gpu, std::uint64_t most_bytes = DeviceChoice::most_bytes);
    // Reads records of pages that choose_on_device() asks for, from the one of that number on, for so long:
    // so nothing waits for files in one go. True once all are read. Errors: a file that cannot be read.
    Result<bool> read_records(std::uint64_t& next, double longest_s, std::uint64_t most_bytes) const;
    // Whether choose_on_device() may leave anything to the device of a scene that asks for what this one
    // does: of frames by other views it may be all the same that none is left.
    [[nodiscard]] bool may_leave_choice() const;
    // Whether plans leave the choice to the device from now on where they may; after choose_on_device() they
    // do. A plan that nobody draws must not: it would never be known what it lacks.
    void leave_choice(bool on);
    // Whether each grid has some ground wherever one looks: its coarsest page is here; of what lies between
    // grids all pages are.
    [[nodiscard]] bool has_coarsest_pages() const;
    // Loads these and waits for them, where memory has room: those of grids that were never in view are not
    // here. No frame is under way, and the last plan lacked nothing. Errors: as advance().
    Result<void> load_coarsest_pages();
    // Loads these without waiting, whatever a frame needs: to be asked again until it is true, which it is
    // once they are here, or memory has no room for the rest. No plan of this scene is drawn before. Errors:
    // as advance().
    Result<bool> advance_coarsest_pages();
    // Whether the last plan lacks pages, as far as is known: where the device chose them the frame tells
    // (apply_feedback()).
    [[nodiscard]] bool lacks_pages() const;
    // Whether nothing of what the last plan lacks will come, for the frame's own pages fill the GPU. advance()
    // finds it out, and until then it is false. What is missing of clusters is not asked about.
    [[nodiscard]] bool lacks_memory() const;
    // What a frame draws with the pages and clusters that are on the GPU now.
    Result<FramePlan> plan(const FrameView& view);
    // Of the last plan, all grids together.
    [[nodiscard]] PlanTimes times_of_plan() const;
    // Lets the background read what the last plan misses, and sends what is ready: true when the next plan
    // may be better. Does not wait for what is not ready; asks for no pages of a grid once the frame's own
    // fill the GPU. Where it was false it is to be asked again for the same frame: hidden pages then evict all
    // that this frame does not use. next: anyway: another plan is made whatever this gives
    // (ClusterScene::advance()). Errors: what cannot be read, the device.
    Result<bool> advance(NextPlan next = NextPlan::if_better);
    // What a frame of this scene has shown (FrameReport::feedback): from the next plan on ground that is
    // hidden comes last, and where the GPU is full gives way to what shows. True where that is news.
    bool apply_feedback(std::span<const FrameFeedback> feedback);
    // Whether plans wait for records of pages that take long, as they do at first (PlanMemory). Where they do
    // not, such pages are missing until they are loaded.
    void wait_for_records(bool on);
    // The next frame is as the first one: what frames have shown is forgotten, and what they left on the GPU
    // is let go of where it could take the room of what comes. Not between a plan and the frame that draws
    // it.
    void forget_frames();
    // A plan once all that tau asks for is there: waits for it. Where a frame needs more than the GPU may
    // hold, `missing` names the rest; drawing it, apply_feedback() and another plan may bring what of that
    // shows. Of clusters it tells how many there is no room for.
    Result<FramePlan> settled_plan(const FrameView& view);

    // Its grids, in the order of FramePlan::grids.
    [[nodiscard]] std::span<GridScene> grids() { return grids_; }
    [[nodiscard]] std::span<const GridScene> grids() const { return grids_; }
    [[nodiscard]] RegionPagesList pages() const;
    // Images over the ground of a grid.
    void set_drape(std::unique_ptr<DrapeStore> drape, std::size_t grid) {
        grids_[grid].drape_ = std::move(drape);
    }
    // Of all grids: what a frame is drawn with.
    [[nodiscard]] std::vector<DrapeStore*> drapes() const;
    // Tiles of images that the GPU may hold for all of them.
    [[nodiscard]] std::size_t image_tiles_max() const;
    // What the pages of a plan take on the GPU, without means and places, bytes.
    [[nodiscard]] std::uint64_t block_bytes(const FramePlan& plan);
    // From one height that the GPU can keep to the next, of the grid where that is most; posts are at most
    // half of it from their own.
    [[nodiscard]] double height_step_m() const;

  private:
    Result<std::vector<GridPlan>> settled_plans(const FrameView& view);
    Result<std::optional<FramePlan>> plan_by_device(const FrameView& view);
    Result<FramePlan> settled_by_device(FramePlan plan);
    // To each grid what the plans of the others show.
    Result<void> share_shadow_receivers(const FrameView& view, std::span<const GridPlan> plans);
    // Lets go of what the grids' frames do not use: true where there is more room now.
    bool evict_unused();

    std::vector<GridScene> grids_;
    ShadowRequest cast_;
};

}  // namespace oro
