#include "render/scene/scene.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <iterator>

#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/frame/casters.h"
#include "core/lod/ground_means.h"
#include "core/made_pages/made_pages.h"
#include "render/made/gpu_post_maker.h"
#include "render/pipelines/plan_pass.h"

namespace oro {
namespace {

Result<Buffer> create_undulation(const Gpu& gpu, const UndulationField& field) {
    const std::size_t size = field.N_m.size() * sizeof(float);
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, size,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::upload, "undulation"));
    std::memcpy(buffer.mapped, field.N_m.data(), size);
    return buffer;
}

// Nodes, then triangles: each is of whole words of 4 bytes, and 32 bytes a node keep what follows aligned. On
// the device: lines read them at random.
Result<Buffer> create_mesh_casters(const Gpu& gpu, const MeshCasters& casters) {
    const VkDeviceSize nodes = casters.nodes.size() * sizeof(gpu::MeshNode),
                       triangles = casters.triangles.size() * sizeof(gpu::MeshTriangle);
    static_assert(sizeof(gpu::MeshNode) == 32 && sizeof(gpu::MeshTriangle) == 36);
    ORO_TRY(const Buffer staging, create_buffer(gpu, nodes + triangles, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                MemoryKind::upload, "meshes on their way"));
    std::memcpy(staging.mapped, casters.nodes.data(), nodes);
    std::memcpy(staging.mapped + nodes, casters.triangles.data(), triangles);
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, nodes + triangles,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "meshes that cast shadows"));
    ORO_TRY(Commands commands, Commands::create(gpu, "meshes on their way"));
    ORO_CHECK(commands.run(gpu, [&](VkCommandBuffer recorded) {
        const VkBufferCopy copy{0, 0, nodes + triangles};
        vkCmdCopyBuffer(recorded, staging.handle.get(), buffer.handle.get(), 1, &copy);
        memory_barrier(recorded, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    }));
    return buffer;
}

// What buffers of a mesh's pages take, with what is left free at the ends of buffers.
Result<std::uint64_t> bytes_of_meshes(const RegionPages& pages) {
    std::uint64_t bytes = std::uint64_t{2} << 20U;
    std::vector<std::uint32_t> words;
    for (int column = 0; column < pages.layout(0).columns; ++column) {
        ORO_CHECK(pages.load_words({0, column, 0}, words));
        const std::uint64_t page = offsetof(gpu::PageBlock, heights) + words.size() * sizeof(words[0]) + 16;
        bytes += page + page / 8;
    }
    return bytes;
}

// Device address of what lies so far before a page's block.
gpu::uvec2 before(const gpu::FramePage& page, std::uint64_t bytes) {
    return address_words((std::uint64_t{page.block.y} << 32U | page.block.x) - bytes);
}

}  // namespace

Result<const ClearedGround::Made*> ClearedGround::made() {
    if (made_) return &*made_;
    Made made{cleared_map_of(casters_), {}};
    const std::size_t size = made.map.cells.size() * sizeof(std::uint32_t);
    ORO_TRY(made.cells,
            create_buffer(gpu_, size,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::mapped_device, "ground near meshes"));
    std::memcpy(made.cells.mapped, made.map.cells.data(), size);
    return &made_.emplace(std::move(made));
}

std::uint64_t gpu_bytes(const Gpu& gpu, std::uint64_t bytes) {
    constexpr std::uint64_t most = std::uint64_t{2} << 30U;
    return bytes > 0 ? bytes : std::min(gpu.report().memory_bytes / 2, most);
}

std::uint64_t main_bytes(std::uint64_t bytes) {
    return bytes > 0 ? bytes : 64'000'000;
}

std::shared_ptr<MemoryBudget> page_budget(const Gpu& gpu, std::uint64_t bytes) {
    return std::make_shared<MemoryBudget>(gpu_bytes(gpu, bytes));
}

Result<GridScene> GridScene::create(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
                                    const SceneMemory& memory, HeightStorage heights, bool means,
                                    HeightMaker maker) {
    const PageParts parts{means && pages->knows_means(),
                          pages->facts().grid.net != nullptr && !pages->has_meshes()};
    ORO_TRY(HeightQuantization coding, height_quantization(*pages, heights));
    // Their words take the place of packed heights.
    if (pages->has_meshes()) coding = {.packed = true};
    std::shared_ptr<MemoryBudget> budget = memory.shared ? memory.shared : page_budget(gpu, memory.gpu);
    if (pages->has_meshes()) {
        ORO_TRY(const std::uint64_t bytes, bytes_of_meshes(*pages));
        budget = std::make_shared<MemoryBudget>(bytes);
    }
    std::shared_ptr<const MadePageHeights> made;
    if (pages->made_ground() != nullptr && MadePageHeights::is_wanted(gpu, maker, coding)) {
        const RegionFacts& facts = pages->facts();
        ORO_TRY(made, MadePageHeights::create(gpu, *pages->made_ground(), facts.undulation,
                                              facts.shape.exaggeration, coding));
        make_posts_by(*pages, gpu_post_maker(gpu));
    }
    PageStore store(gpu, budget, coding, parts, made);
    GridScene scene(std::move(pages), std::move(store));
    scene.shared_memory_ = memory.shared;
    static std::atomic<std::uint64_t> scenes{0};
    scene.number_ = ++scenes;
    const std::uint64_t under_way = main_bytes(memory.main) / memory.shares;
    const std::size_t page_size = page_bytes({}, parts);
    scene.loader_ = page_loader(*scene.pages_, thread_count(), under_way / page_size, parts, coding.packed,
                                made != nullptr);
    const UndulationField& undulation = scene.pages_->facts().undulation;
    if (!undulation.N_m.empty()) {
        ORO_TRY(scene.undulation_, create_undulation(gpu, undulation));
    }
    if (const MeshCasters* const casters = scene.pages_->mesh_casters(); casters != nullptr) {
        ORO_TRY(scene.mesh_casters_, create_mesh_casters(gpu, *casters));
        scene.cleared_ = std::make_shared<ClearedGround>(gpu, *casters);
    }
    if (scene.pages_->has_meshes() && memory.shared)
        scene.of_meshes_ = MemoryBudget::take(memory.shared, budget->bytes() + scene.mesh_casters_.size);
    return scene;
}

bool GridScene::is_hidden(const PageIndex& page) const {
    return hidden_.contains(page);
}

bool GridScene::apply_feedback(const FrameFeedback& feedback) {
    if (clusters_) clusters_->apply_feedback(feedback);
    const bool is_new = seen_.add(feedback);
    if (!choice_ || !feedback.choice) return is_new;
    if (!left_choice_) {
        choice_->apply_changes(*feedback.choice);
        return is_new;
    }
    const bool is_news =
        choice_->apply(*feedback.choice, [&](const PageIndex& page) { return seen_.is_hidden(page); });
    needs_plan_ = needs_plan_ || !choice_->is_whole();
    // What gives way once memory is full is what was not shown for longest.
    constexpr std::uint64_t frames_between_marks = 8;
    if (store_.frame() % frames_between_marks == 0)
        choice_->for_each_here(*feedback.choice, [&](const PageIndex& page) { store_.address(page); });
    DeviceChoice::Missing lacks = choice_->missing();
    set_missed(std::move(lacks.pages), lacks.hidden);
    return is_new || is_news;
}

void GridScene::set_missed(std::vector<PageIndex> missing, std::size_t hidden) {
    missed_ = std::move(missing);
    const auto missing_hidden = std::span(missed_).last(hidden);
    hidden_ = {missing_hidden.begin(), missing_hidden.end()};
}

bool GridScene::lacks_pages() const {
    return !missed_.empty() || needs_plan_;
}

bool GridScene::lacks_memory() const {
    return !missed_.empty() && ((full_ && !can_evict_hidden_) || full_for_all_hidden_);
}

// Where the last frame's pages filled the GPU and more of them show, those that do not show are planned
// without: what comes next may take their place.
Result<GridPlan> GridScene::plan_of_pages(const FrameView& view) {
    const double spacing_px = store_.means_offset() > 0 ? means_spacing_px_ : gpu::shading_spacing_px;
    const auto planned = [&](const Residency& residency) {
        store_.begin_frame();
        return plan_grid(memory_, residency, view, store_.coding(), spacing_px,
                         [&](const PageIndex& page) { return seen_.is_hidden(page); });
    };
    ORO_TRY(GridPlan plan, planned([&](const PageIndex& page) { return store_.address(page); }));
    if (store_.means_offset() > 0 && spacing_px < gpu::means_spacing_px &&
        (full_ || plan.pages.size() + plan.missing.size() > store_.capacity())) {
        means_spacing_px_ = gpu::means_spacing_px;
        full_ = false;
        return plan_of_pages(view);
    }
    can_evict_hidden_ = plan.missing.size() > plan.missing_hidden && !plan.hidden.empty();
    if (!std::exchange(full_, false) || !can_evict_hidden_) return plan;
    can_evict_hidden_ = false;
    hidden_ = {plan.hidden.begin(), plan.hidden.end()};
    ORO_TRY(plan, planned([&](const PageIndex& page) { return is_hidden(page) ? 0 : store_.address(page); }));
    // They are there, and need not come.
    const std::size_t before = plan.missing.size();
    std::erase_if(plan.missing, [&](const PageIndex& page) { return is_hidden(page); });
    plan.missing_hidden -= std::min(plan.missing_hidden, before - plan.missing.size());
    return plan;
}

// What casters need shows by what they cast: it comes before what is hidden.
Result<void> GridScene::add_casters(const FrameView& view, GridPlan& plan) {
    if (!top_m_) {
        ORO_TRY(top_m_, region_top_m(*pages_));
    }
    const auto first_hidden = plan.missing.end() - static_cast<std::ptrdiff_t>(plan.missing_hidden);
    const std::vector<PageIndex> hidden(first_hidden, plan.missing.end());
    plan.missing.erase(first_hidden, plan.missing.end());
    ORO_CHECK(plan_casters(
        memory_, [&](const PageIndex& page) { return store_.address(page); }, view, cast_, *top_m_, plan,
        receivers_));
    plan.missing_hidden = 0;
    if (hidden.empty()) return {};
    const std::set<PageIndex> wanted(plan.missing.begin(), plan.missing.end());
    for (const PageIndex& page : hidden) {
        if (wanted.contains(page)) continue;
        plan.missing.push_back(page);
        ++plan.missing_hidden;
    }
    return {};
}

// The records are those that the choice of pages has read.
Result<void> GridScene::add_growth(const FrameView& view, GridPlan& plan) {
    if (!(has_trees_ || has_grass_) || view.model.earth != Earth::ellipsoid || plan.pages.empty()) return {};
    std::vector<GroundRange> ranges;
    ranges.reserve(plan.page_indices.size());
    for (std::size_t i = 0; i < plan.page_indices.size(); ++i) {
        ORO_TRY(const KeptPage* const page, memory_.page_of(plan, i));
        ranges.push_back({page->record.summary.lowest_h_m, page->record.summary.highest_h_m});
    }
    const auto ground = [&](std::size_t page) { return ranges[page]; };
    const GrowthView from{view.camera, view.tile, view.tau_px, pages_->facts().shape.exaggeration};
    if (has_trees_) plan.growth = plan_growth(pages_->facts().grid, plan.page_indices, ground, from);
    if (has_grass_) plan.meadow = plan_meadow(pages_->facts().grid, plan.page_indices, ground, from);
    return {};
}

Result<void> GridScene::add_clusters(const FrameView& view, Clusters clusters, GridPlan& plan) {
    const auto& [camera, tile, tau_px, model] = view;
    // A plan with no page shows nothing.
    if (!clusters_ || model.earth != Earth::ellipsoid || plan.pages.empty()) return {};
    const HorizonOccluder& occluder = pages_->facts().shape.occluder;
    if (clusters == Clusters::waited_for)
        return clusters_->append_full_cut(plan, camera, tile, tau_px, model, occluder, store_.coding());
    return clusters_->append_resident_cut(plan, camera, tile, tau_px, model, occluder, store_.coding());
}

Result<GridPlan> GridScene::plan(const FrameView& view, Clusters clusters) {
    ORO_TRY(GridPlan plan, begun_plan(view, clusters));
    ORO_CHECK(end_plan(view, plan));
    return plan;
}

bool GridScene::may_leave_choice() const {
    return !clusters_ && !cast_.any() && !has_trees_ && !has_grass_ && !drape_;
}

bool GridScene::can_leave_choice() const {
    if (!choice_ || !leaves_choice_ || needs_plan_ || !may_leave_choice() || full_ || full_for_hidden_ ||
        !choice_->has_room() || choice_->last_page_count() > store_.capacity())
        return false;
    // Where memory is full the processor says what gives way for what comes, until nothing has come for some
    // frames.
    constexpr std::uint32_t plans_between = 30;
    return store_.has_capacity() ||
           (missed_.empty() && (left_choice_ || choice_->whole_plans() >= plans_between));
}

Result<std::optional<GridPlan>> GridScene::plan_by_device(const FrameView& view) {
    const auto start = Clock::now();
    std::optional<GridPlan> plan = plan_without_pages(memory_, view, store_.coding());
    if (!plan) return std::optional<GridPlan>();
    left_choice_ = true;
    store_.begin_frame();
    choice_->note_pages(store_);
    choice_->plan(view, ModelView(view.camera, view.model, store_.coding()),
                  store_.means_offset() > 0 ? means_spacing_px_ : gpu::shading_spacing_px,
                  store_.means_offset(), *plan);
    times_ = {};
    times_.pages_s = seconds_since(start);
    return plan;
}

Result<GridPlan> GridScene::begun_plan(const FrameView& view, Clusters clusters) {
    auto start = Clock::now();
    left_choice_ = needs_plan_ = false;
    ORO_TRY(GridPlan plan, plan_of_pages(view));
    for (const PageIndex& page : plan.hidden) store_.mark_occluded(page);
    if (choice_) choice_->note_plan(plan);
    times_.pages_s = seconds_since(start);
    start = Clock::now();
    ORO_CHECK(add_clusters(view, clusters, plan));
    times_.clusters_s = seconds_since(start);
    return plan;
}

Result<void> GridScene::end_plan(const FrameView& view, GridPlan& plan) {
    auto start = Clock::now();
    if (cast_.any()) ORO_CHECK(add_casters(view, plan));
    times_.casters_s = seconds_since(start);
    start = Clock::now();
    ORO_CHECK(add_growth(view, plan));
    times_.growth_s = seconds_since(start);
    full_for_hidden_ = full_for_all_hidden_ = false;
    set_missed(plan.missing, plan.missing_hidden);
    plan.request_feedback = !plan.missing.empty() || !store_.has_capacity() || plan.clusters.missing > 0 ||
                            (plan.clusters.on && !clusters_->has_capacity());
    if (store_.means_offset() > 0) {
        plan.constants.has_means = 1;
        for (gpu::FramePage& page : plan.pages) page.means = before(page, store_.means_offset());
    }
    if (store_.places_before() > 0) {
        for (gpu::FramePage& page : plan.pages) page.places = before(page, store_.places_before());
    }
    plan.constants.undulation.N_m = address_words(undulation_.address);
    plan.heights = number_;
    if (const MeshCasters* const casters = pages_->mesh_casters(); casters != nullptr) {
        plan.mesh_casters = mesh_casters_.address;
        plan.mesh_nodes = casters->nodes.size();
        plan.mesh_origin_m = casters->origin_m;
    }
    if (cleared_ && wants_cleared_ && view.model.earth == Earth::ellipsoid) {
        ORO_TRY(const ClearedGround::Made* const cleared, cleared_->made());
        plan.constants.cleared = cleared_in_view(cleared->map, view.camera);
        plan.constants.cleared.cells = address_words(cleared->cells.address);
    }
    return {};
}

Result<GridScene::Sent> GridScene::send_ready(bool wait, PageStore::Evictions evictions) {
    ORO_TRY(std::vector<LoadedPage> ready, loader_->take(wait));
    for (LoadedPage& page : ready) page.is_hidden = is_hidden(page.index);
    std::ranges::stable_partition(ready, [](const LoadedPage& page) { return !page.is_hidden; });
    Sent sent;
    if (left_choice_) {
        // What gives way is none of the frame's: that is known once the processor has planned one.
        ORO_TRY(sent.count, store_.send(ready, PageStore::Evictions::none));
        needs_plan_ = needs_plan_ || sent.count < ready.size();
        return sent;
    }
    ORO_TRY(sent.count, store_.send(ready, evictions));
    if (sent.count < ready.size()) (ready[sent.count].is_hidden ? sent.hidden_left : sent.shown_left) = true;
    return sent;
}

std::vector<PageIndex> GridScene::shown_of(std::span<const PageIndex> missing) const {
    std::vector<PageIndex> shown;
    std::ranges::copy_if(missing, std::back_inserter(shown),
                         [&](const PageIndex& page) { return !is_hidden(page); });
    return shown;
}

Result<bool> GridScene::advance(NextPlan next) {
    bool better = false;
    if (clusters_) {
        ORO_TRY(better, clusters_->advance(next));
    }
    if (full_ || full_for_all_hidden_) return better;
    const std::vector<PageIndex> shown = full_for_hidden_ ? shown_of(missed_) : missed_;
    // An eye that moves has another plan by now. One that rests needs what was shown lately no more.
    const bool lacks_hidden_alone = shown.empty() && !missed_.empty();
    loader_->request(lacks_hidden_alone ? missed_ : shown);
    if (left_choice_ && !missed_.empty() && !store_.has_capacity()) {
        needs_plan_ = true;
        return true;
    }
    using enum PageStore::Evictions;
    ORO_TRY(const Sent sent, send_ready(false, lacks_hidden_alone ? of_all_unused : of_unused));
    full_for_all_hidden_ = lacks_hidden_alone && sent.hidden_left;
    full_for_hidden_ = full_for_hidden_ || sent.hidden_left;
    full_ = sent.shown_left;
    if (full_) loader_->cancel();
    return better || sent.count > 0 || needs_plan_ || (full_ && can_evict_hidden_);
}

void GridScene::forget_frames(bool gives_back) {
    seen_ = VisibilityFeedback(*pages_);
    hidden_.clear();
    missed_.clear();
    receivers_.clear();
    full_ = full_for_hidden_ = full_for_all_hidden_ = can_evict_hidden_ = left_choice_ = needs_plan_ = false;
    means_spacing_px_ = asked_means_px_;
    loader_->cancel();
    if (gives_back) {
        store_.clear();
        store_.begin_frame();
        store_.release_unused();
    }
    if (clusters_) clusters_->forget_frames();
    if (choice_) choice_->forget();
}

// Pages become ready in any order, so no more are asked for than there is room for. Where they differ in size
// there may be room for others then.
Result<bool> GridScene::load_pages(std::span<const PageIndex> all_pages) {
    while (!all_pages.empty()) {
        const std::span<const PageIndex> pages =
            all_pages.first(std::min(all_pages.size(), store_.free_capacity()));
        loader_->request(pages);
        if (pages.empty()) return false;
        for (std::size_t count = 0; count < pages.size();) {
            ORO_TRY(const Sent sent, send_ready(true));
            count += sent.count;
            if (sent.hidden_left || sent.shown_left) {
                loader_->cancel();
                return false;
            }
            if (sent.count == 0) break;
        }
        all_pages = all_pages.subspan(pages.size());
    }
    return true;
}

Result<GridPlan> GridScene::settled_plan(const FrameView& view) {
    for (bool begun_anew = false;;) {
        ORO_TRY(GridPlan frame, plan(view, Clusters::waited_for));
        if (frame.missing.empty()) return frame;
        ORO_TRY(bool fits, load_pages(shown_of(frame.missing)));
        if (!fits && can_evict_hidden_) {
            full_ = true;  // so that the next plan lets hidden pages give way
            continue;
        }
        if (fits && frame.missing_hidden == frame.missing.size()) {
            ORO_TRY(fits, load_pages(frame.missing));
        }
        // What other frames left may lie so that there is room, and not in one piece.
        if (!fits && store_.has_pieces() && !std::exchange(begun_anew, true)) {
            store_.clear();
            continue;
        }
        if (!fits) return plan(view, Clusters::waited_for);
    }
}

Result<Scene> Scene::create(const Gpu& gpu, std::unique_ptr<RegionPages> pages, const SceneMemory& memory,
                            HeightStorage heights, bool means, HeightMaker maker) {
    ORO_TRY(GridScene grid, GridScene::create(gpu, std::move(pages), memory, heights, means, maker));
    Scene scene;
    scene.grids_.push_back(std::move(grid));
    return scene;
}

void Scene::add(Scene other) {
    assert(!grids_.front().clusters_ && !other.grids_.front().clusters_);
    std::ranges::move(other.grids_, std::back_inserter(grids_));
    const auto with_meshes =
        std::ranges::find_if(grids_, [](const GridScene& grid) { return grid.cleared_ != nullptr; });
    if (with_meshes == grids_.end()) return;
    for (GridScene& grid : grids_) grid.cleared_ = with_meshes->cleared_;
}

// What others hold that no frame uses makes room for them.
void Scene::replace_between(std::optional<Scene> other) {
    while (grids_.size() > 1 && !grids_.back().pages_->has_posts()) grids_.pop_back();
    for (GridScene& grid : grids_) grid.cleared_.reset();
    if (other) add(std::move(*other));
    const std::shared_ptr<MemoryBudget>& shared = grids_.front().shared_memory();
    if (shared && shared->left() == 0) evict_unused();
}

void Scene::set_fallback_to_blocks(bool on) {
    for (GridScene& grid : grids_)
        if (grid.clusters_) grid.clusters_->set_fallback_to_blocks(on);
}

void Scene::draw_clusters(ClusterScene clusters) {
    assert(grids_.size() == 1 && grids_.front().memory_.sources() == nullptr);
    grids_.front().clusters_.emplace(std::move(clusters));
}

void Scene::set_shadow_request(const ShadowRequest& request) {
    cast_ = request;
    // What lies between grids casts nothing: they do.
    for (GridScene& grid : grids_)
        if (grid.pages_->has_posts()) grid.cast_ = request;
}

void Scene::set_footprint_spacing(double spacing_px) {
    for (GridScene& grid : grids_)
        if (spacing_px != grid.asked_means_px_) grid.means_spacing_px_ = grid.asked_means_px_ = spacing_px;
}

// What lies between grids is as wide as a gap: no tree stands there.
void Scene::set_trees(bool on) {
    for (GridScene& grid : grids_) grid.has_trees_ = on && grid.pages_->has_posts();
}

void Scene::set_grass(bool on) {
    for (GridScene& grid : grids_) grid.has_grass_ = on && grid.pages_->has_posts();
}

void Scene::require_fields(const gpu::FrameStyle& style) {
    set_trees((style.materials.on & gpu::materials_with_trees) != 0);
    set_grass((style.materials.on & gpu::materials_with_grass) != 0);
    for (GridScene& grid : grids_) grid.wants_cleared_ = style.materials.on != 0;
    set_shadow_request(shadow_request(style));
    set_footprint_spacing(means_spacing_px(style));
}

Result<bool> Scene::plan_on_device(const Gpu& gpu) {
    constexpr std::uint64_t most_bytes = 64'000'000;
    if (!PlanPass::can_run(gpu)) return false;
    for (GridScene& grid : grids_) {
        if (grid.memory_.sources() != nullptr || grid.clusters_ || grid.pages_->facts().grid.net) continue;
        const std::uint64_t bytes = PlanSources::bytes_of(*grid.pages_);
        if (bytes == 0 || bytes > most_bytes) continue;
        ORO_TRY(grid.plan_sources_,
                create_buffer(gpu, bytes,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              MemoryKind::mapped_device, "sources of plans"));
        const Buffer& sources = grid.plan_sources_;
        grid.memory_.set_sources(PlanSources(*grid.pages_, {sources.mapped, bytes}, sources.address));
    }
    return true;
}

Result<bool> Scene::choose_on_device(const Gpu& gpu, std::uint64_t most_bytes) {
    ORO_TRY(const bool can, plan_on_device(gpu));
    if (!can) return false;
    for (GridScene& grid : grids_) {
        if (grid.choice_ || grid.memory_.sources() == nullptr ||
            !can_choose_on_device(*grid.pages_, most_bytes))
            continue;
        ORO_CHECK(grid.memory_.sources()->fill(grid.memory_.angles()));
        ORO_TRY(DeviceChoice choice, DeviceChoice::create(gpu, *grid.pages_));
        grid.choice_.emplace(std::move(choice));
    }
    return true;
}

Result<bool> Scene::read_records(std::uint64_t& next, double longest_s, std::uint64_t most_bytes) const {
    const auto start = Clock::now();
    std::uint64_t before = 0;
    for (const GridScene& grid : grids_) {
        if (!can_choose_on_device(*grid.pages_, most_bytes)) continue;
        for (int level = 0; level < grid.pages_->levels(); ++level) {
            const PageLayout layout = grid.pages_->layout(level);
            while (next < before + layout.count()) {
                const auto number = static_cast<int>(next++ - before);
                ORO_CHECK(grid.pages_->record({number / layout.columns, number % layout.columns, level}));
                if (seconds_since(start) > longest_s) return false;
            }
            before += layout.count();
        }
    }
    return true;
}

void Scene::wait_for_records(bool on) {
    for (GridScene& grid : grids_) grid.memory_.wait_for_records(on);
}

void Scene::leave_choice(bool on) {
    for (GridScene& grid : grids_) grid.leaves_choice_ = on;
}

std::vector<PageIndex> GridScene::coarsest_pages() const {
    const int top = pages_->levels() - 1;
    const PageLayout layout = pages_->layout(top);
    std::vector<PageIndex> pages;
    for (int row = 0; row < layout.rows; ++row)
        for (int column = 0; column < layout.columns; ++column) pages.push_back({row, column, top});
    return pages;
}

bool GridScene::has_coarsest_pages() const {
    return std::ranges::all_of(coarsest_pages(), [&](const PageIndex& page) { return store_.has(page); });
}

bool Scene::has_coarsest_pages() const {
    return std::ranges::all_of(grids_, &GridScene::has_coarsest_pages);
}

Result<void> Scene::load_coarsest_pages() {
    for (GridScene& grid : grids_) {
        if (grid.has_coarsest_pages()) continue;
        const std::vector<PageIndex> pages = grid.coarsest_pages();
        if (pages.size() < grid.store_.free_capacity()) ORO_CHECK(grid.load_pages(pages));
    }
    return {};
}

Result<bool> GridScene::advance_coarsest_pages() {
    std::vector<PageIndex> missing = coarsest_pages();
    std::erase_if(missing, [&](const PageIndex& page) { return store_.has(page); });
    if (missing.empty()) return true;
    loader_->request(missing);
    ORO_TRY(const Sent sent, send_ready(false));
    return sent.shown_left || sent.count == missing.size();
}

Result<bool> Scene::advance_coarsest_pages() {
    bool are_here = true;
    for (GridScene& grid : grids_) {
        ORO_TRY(const bool all, grid.advance_coarsest_pages());
        are_here = are_here && all;
    }
    return are_here;
}

bool Scene::lacks_pages() const {
    return std::ranges::any_of(grids_, &GridScene::lacks_pages);
}

bool Scene::lacks_memory() const {
    const auto waits = [](const GridScene& grid) { return grid.lacks_pages() && !grid.lacks_memory(); };
    return lacks_pages() && std::ranges::none_of(grids_, waits);
}

bool Scene::may_leave_choice() const {
    return std::ranges::all_of(grids_, &GridScene::may_leave_choice);
}

std::vector<DrapeStore*> Scene::drapes() const {
    std::vector<DrapeStore*> all;
    for (const GridScene& grid : grids_) all.push_back(grid.drape());
    return all;
}

RegionPagesList Scene::pages() const {
    std::vector<const RegionPages*> all;
    for (const GridScene& grid : grids_) all.push_back(grid.pages_.get());
    return RegionPagesList(std::move(all));
}

std::size_t Scene::image_tiles_max() const {
    std::size_t tiles = 0;
    for (const DrapeStore* const drape : drapes()) tiles += drape == nullptr ? 0 : drape->capacity();
    return tiles;
}

double Scene::height_step_m() const {
    double step_m = 0.0;
    for (const GridScene& grid : grids_) step_m = std::max(step_m, grid.store_.coding().step_m());
    return step_m;
}

std::uint64_t Scene::block_bytes(const FramePlan& plan) {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < grids_.size(); ++i)
        for (const PageIndex& page : plan.grids[i].page_indices) bytes += grids_[i].store_.block_bytes(page);
    return bytes;
}

// Ground that another grid draws is ground that a grid's terrain may darken.
Result<void> Scene::share_shadow_receivers(const FrameView& view, std::span<const GridPlan> plans) {
    for (GridScene& grid : grids_) grid.receivers_.clear();
    if (!cast_.sun_enu || grids_.size() == 1) return {};
    for (std::size_t i = 0; i < plans.size(); ++i) {
        ORO_TRY(const std::vector<ShadowReceiver> shown, shadow_receivers(grids_[i].memory_, view, plans[i]));
        for (std::size_t j = 0; j < grids_.size(); ++j)
            if (j != i) std::ranges::copy(shown, std::back_inserter(grids_[j].receivers_));
    }
    return {};
}

// Pages of all grids are chosen there, or none.
Result<std::optional<FramePlan>> Scene::plan_by_device(const FrameView& view) {
    if (!std::ranges::all_of(grids_, &GridScene::can_leave_choice)) return std::optional<FramePlan>();
    FramePlan plan{view, {}};
    for (GridScene& grid : grids_) {
        ORO_TRY(std::optional<GridPlan> one, grid.plan_by_device(view));
        if (!one) return std::optional<FramePlan>();
        plan.grids.push_back(std::move(*one));
    }
    for (std::size_t i = 0; i < grids_.size(); ++i) ORO_CHECK(grids_[i].end_plan(view, plan.grids[i]));
    return std::optional(std::move(plan));
}

// The same frame: what is missing the processor has found out.
Result<FramePlan> Scene::settled_by_device(FramePlan plan) {
    ORO_TRY(std::optional<FramePlan> chosen, plan_by_device(plan.view));
    if (!chosen) return plan;
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        GridPlan &to = chosen->grids[i], &from = plan.grids[i];
        to.missing = std::move(from.missing);
        to.missing_hidden = from.missing_hidden;
        to.hidden = std::move(from.hidden);
        to.pages_wanted = from.pages_wanted;
        to.pages_beyond_frustum = from.pages_beyond_frustum;
        to.pages_beyond_horizon = from.pages_beyond_horizon;
        to.request_feedback = from.request_feedback;
    }
    return std::move(*chosen);
}

Result<FramePlan> Scene::plan(const FrameView& view) {
    ORO_TRY(std::optional<FramePlan> by_device, plan_by_device(view));
    if (by_device) return std::move(*by_device);
    FramePlan plan{view, {}};
    for (GridScene& grid : grids_) {
        ORO_TRY(GridPlan begun, grid.begun_plan(view, GridScene::Clusters::that_are_here));
        plan.grids.push_back(std::move(begun));
    }
    ORO_CHECK(share_shadow_receivers(view, plan.grids));
    for (std::size_t i = 0; i < grids_.size(); ++i) ORO_CHECK(grids_[i].end_plan(view, plan.grids[i]));
    return plan;
}

PlanTimes Scene::times_of_plan() const {
    PlanTimes all;
    for (const GridScene& grid : grids_) {
        all.pages_s += grid.times_.pages_s;
        all.clusters_s += grid.times_.clusters_s;
        all.casters_s += grid.times_.casters_s;
        all.growth_s += grid.times_.growth_s;
    }
    return all;
}

bool Scene::apply_feedback(std::span<const FrameFeedback> feedback) {
    bool is_new = false;
    for (std::size_t i = 0; i < grids_.size(); ++i)
        is_new = grids_[i].apply_feedback(i < feedback.size() ? feedback[i] : FrameFeedback()) || is_new;
    return is_new;
}

// A grid that is full takes the place of what it has itself; where there are several, the others may hold
// what none of this frame's uses: that is for the next.
Result<bool> Scene::advance(NextPlan next) {
    bool better = false;
    for (GridScene& grid : grids_) {
        ORO_TRY(const bool more, grid.advance(next));
        better = better || more;
    }
    if (grids_.size() > 1 && std::ranges::any_of(grids_, &GridScene::full_)) evict_unused();
    return better;
}

// Where any grid's memory is full, what the others hold of it may be what earlier frames left.
void Scene::forget_frames() {
    const bool full =
        std::ranges::any_of(grids_, [](const GridScene& grid) { return !grid.store_.has_capacity(); });
    for (GridScene& grid : grids_) grid.forget_frames(full);
}

bool Scene::evict_unused() {
    bool any = false;
    for (GridScene& grid : grids_) any = grid.store_.release_unused() || any;
    return any;
}

Result<FramePlan> Scene::settled_plan(const FrameView& view) {
    ORO_CHECK(share_shadow_receivers(view, {}));
    ORO_TRY(std::vector<GridPlan> plans, settled_plans(view));
    if (grids_.size() > 1 && cast_.sun_enu) {
        // What each of them shows is known: what the others need to cast on that comes, too.
        ORO_CHECK(share_shadow_receivers(view, plans));
        ORO_TRY(plans, settled_plans(view));
    }
    return settled_by_device(FramePlan{view, std::move(plans)});
}

Result<std::vector<GridPlan>> Scene::settled_plans(const FrameView& view) {
    std::vector<GridPlan> plans;
    for (GridScene& grid : grids_) {
        ORO_TRY(GridPlan plan, grid.settled_plan(view));
        if (!plan.missing.empty() && grids_.size() > 1) {
            // Others may hold what earlier frames used. What this frame uses of theirs they say by a plan.
            for (GridScene& other : grids_)
                if (&other != &grid) ORO_CHECK(other.plan(view, GridScene::Clusters::waited_for));
            if (evict_unused()) {
                ORO_TRY(plan, grid.settled_plan(view));
            }
        }
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace oro
