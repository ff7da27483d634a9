#include "render/scene/scene.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>

#include "core/base/parallel.h"
#include "core/frame/casters.h"
#include "core/lod/ground_means.h"

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

// Device address of what lies so far before a page's block.
gpu::uvec2 before(const gpu::FramePage& page, std::uint64_t bytes) {
    return address_words((std::uint64_t{page.block.y} << 32U | page.block.x) - bytes);
}

}  // namespace

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

Result<Scene> Scene::create(const Gpu& gpu, std::unique_ptr<RegionPages> pages, const SceneMemory& memory,
                            HeightStorage heights, bool means) {
    const PageParts parts{means && pages->knows_means(), pages->facts().grid.net != nullptr};
    ORO_TRY(const HeightQuantization coding, height_quantization(*pages, heights));
    PageStore store(gpu, memory.shared ? memory.shared : page_budget(gpu, memory.gpu), coding, parts);
    Scene scene(std::move(pages), std::move(store));
    static std::atomic<std::uint64_t> scenes{0};
    scene.number_ = ++scenes;
    const std::uint64_t under_way = main_bytes(memory.main) / memory.shares;
    const std::size_t page_size = page_bytes({}, parts);
    scene.loader_ = page_loader(*scene.pages_, thread_count(), under_way / page_size, parts, coding.packed);
    const UndulationField& undulation = scene.pages_->facts().undulation;
    if (!undulation.N_m.empty()) {
        ORO_TRY(scene.undulation_, create_undulation(gpu, undulation));
    }
    return scene;
}

void Scene::cast(const CastRequest& request) {
    // What lies between grids casts nothing: they do.
    if (!pages_->is_seam()) cast_ = request;
    for (Scene& other : beside_) other.cast(request);
}

void Scene::hold_means(double spacing_px) {
    if (spacing_px != asked_means_px_) means_spacing_px_ = asked_means_px_ = spacing_px;
    for (Scene& other : beside_) other.hold_means(spacing_px);
}

void Scene::hold_for(const gpu::FrameStyle& style) {
    cast(cast_request(style));
    hold_means(means_spacing_px(style));
}

std::vector<DrapeStore*> Scene::drapes() const {
    std::vector<DrapeStore*> all{drape_.get()};
    for (const Scene& other : beside_) all.push_back(other.drape_.get());
    return all;
}

std::size_t Scene::image_tiles_max() const {
    std::size_t tiles = 0;
    for (const DrapeStore* const drape : drapes()) tiles += drape == nullptr ? 0 : drape->capacity();
    return tiles;
}

Result<FramePlan> Scene::plan(const Camera& camera, const Tile& tile, double tau_px,
                              const WorldModel& model) {
    const std::vector<Scene*> scenes = all();
    std::vector<FramePlan> plans;
    for (Scene* const scene : scenes) {
        ORO_TRY(FramePlan begun, scene->begun_plan(camera, tile, tau_px, model, Clusters::that_are_here));
        plans.push_back(std::move(begun));
    }
    ORO_CHECK(tell_receivers(camera, tile, plans));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        ORO_CHECK(scenes[i]->end_plan(camera, tile, plans[i]));
        if (i > 0) scenes[i]->missed_ = plans[i].missing;
    }
    return joined(std::move(plans));
}

FramePlan Scene::joined(std::vector<FramePlan> plans) {
    FramePlan plan = std::move(plans.front());
    plan.beside.assign(std::make_move_iterator(plans.begin() + 1), std::make_move_iterator(plans.end()));
    return plan;
}

// Ground that another grid draws is ground that a grid's terrain may darken.
Result<void> Scene::tell_receivers(const Camera& camera, const Tile& tile,
                                   const std::vector<FramePlan>& plans) {
    if (beside_.empty()) return {};
    const std::vector<Scene*> scenes = all();
    for (Scene* const scene : scenes) scene->shown_beside_.clear();
    if (!cast_.sun_enu) return {};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        ORO_TRY(const std::vector<CastReceiver> shown,
                cast_receivers(*scenes[i]->pages_, camera, tile, plans[i]));
        for (std::size_t j = 0; j < scenes.size(); ++j)
            if (j != i)
                scenes[j]->shown_beside_.insert(scenes[j]->shown_beside_.end(), shown.begin(), shown.end());
    }
    return {};
}

bool Scene::is_hidden(const PageIndex& page) const {
    return hidden_.contains({page.level, page.row, page.column});
}

bool Scene::saw(std::span<const FrameSights> sights) {
    bool is_new = false;
    const std::vector<Scene*> scenes = all();
    for (std::size_t i = 0; i < std::min(sights.size(), scenes.size()); ++i)
        is_new = scenes[i]->seen_.add(sights[i]) || is_new;
    if (clusters_) clusters_->saw(sights.empty() ? FrameSights() : sights.front());
    return is_new;
}

// Where the last frame's pages filled the GPU and more of them show, those that do not show are planned
// without: what comes next may take their place.
Result<FramePlan> Scene::plan_of_pages(const Camera& camera, const Tile& tile, double tau_px,
                                       const WorldModel& model) {
    const double spacing_px = store_.means_before() > 0 ? means_spacing_px_ : gpu::shading_spacing_px;
    const auto planned = [&](const Residency& residency) {
        store_.begin_frame();
        return plan_frame(*pages_, residency, camera, tile, tau_px, model, store_.coding(), spacing_px,
                          [&](const PageIndex& page) { return seen_.is_hidden(page); });
    };
    ORO_TRY(FramePlan plan, planned([&](const PageIndex& page) { return store_.address(page); }));
    if (store_.means_before() > 0 && spacing_px < gpu::means_spacing_px &&
        (full_ || plan.pages.size() + plan.missing.size() > store_.capacity())) {
        means_spacing_px_ = gpu::means_spacing_px;
        full_ = false;
        return plan_of_pages(camera, tile, tau_px, model);
    }
    can_give_way_ = plan.missing.size() > plan.missing_hidden && !plan.hidden.empty();
    if (!std::exchange(full_, false) || !can_give_way_) return plan;
    can_give_way_ = false;
    hidden_.clear();
    for (const PageIndex& page : plan.hidden) hidden_.insert({page.level, page.row, page.column});
    ORO_TRY(plan, planned([&](const PageIndex& page) { return is_hidden(page) ? 0 : store_.address(page); }));
    // They are there, and need not come.
    const std::size_t before = plan.missing.size();
    std::erase_if(plan.missing, [&](const PageIndex& page) { return is_hidden(page); });
    plan.missing_hidden -= std::min(plan.missing_hidden, before - plan.missing.size());
    return plan;
}

// What casters need shows by what they cast: it comes before what is hidden.
Result<void> Scene::add_casters(const Camera& camera, const Tile& tile, FramePlan& plan) {
    if (!top_m_) {
        ORO_TRY(top_m_, region_top_m(*pages_));
    }
    const auto first_hidden = plan.missing.end() - static_cast<std::ptrdiff_t>(plan.missing_hidden);
    const std::vector<PageIndex> hidden(first_hidden, plan.missing.end());
    plan.missing.erase(first_hidden, plan.missing.end());
    ORO_CHECK(plan_casters(
        *pages_, [&](const PageIndex& page) { return store_.address(page); }, camera, tile, cast_, *top_m_,
        plan, shown_beside_));
    plan.missing_hidden = 0;
    std::set<std::tuple<int, int, int>> wanted;
    for (const PageIndex& page : plan.missing) wanted.insert({page.level, page.row, page.column});
    for (const PageIndex& page : hidden) {
        if (wanted.contains({page.level, page.row, page.column})) continue;
        plan.missing.push_back(page);
        ++plan.missing_hidden;
    }
    return {};
}

Result<void> Scene::add_clusters(const Camera& camera, const Tile& tile, double tau_px,
                                 const WorldModel& model, Clusters clusters, FramePlan& plan) {
    // A plan with no page shows nothing.
    if (!clusters_ || !beside_.empty() || model.earth != Earth::ellipsoid || plan.pages.empty()) return {};
    const HorizonOccluder& occluder = pages_->facts().shape.occluder;
    if (clusters == Clusters::waited_for)
        return clusters_->add_to(plan, camera, tile, tau_px, model, occluder, store_.coding());
    return clusters_->add_what_is_here(plan, camera, tile, tau_px, model, occluder, store_.coding());
}

Result<FramePlan> Scene::own_plan(const Camera& camera, const Tile& tile, double tau_px,
                                  const WorldModel& model, Clusters clusters) {
    ORO_TRY(FramePlan plan, begun_plan(camera, tile, tau_px, model, clusters));
    ORO_CHECK(end_plan(camera, tile, plan));
    return plan;
}

// Without what casts shadows.
Result<FramePlan> Scene::begun_plan(const Camera& camera, const Tile& tile, double tau_px,
                                    const WorldModel& model, Clusters clusters) {
    ORO_TRY(FramePlan plan, plan_of_pages(camera, tile, tau_px, model));
    for (const PageIndex& page : plan.hidden) store_.note_hidden(page);
    ORO_CHECK(add_clusters(camera, tile, tau_px, model, clusters, plan));
    return plan;
}

Result<void> Scene::end_plan(const Camera& camera, const Tile& tile, FramePlan& plan) {
    if (cast_.any()) ORO_CHECK(add_casters(camera, tile, plan));
    full_for_hidden_ = false;
    hidden_.clear();
    for (const PageIndex& page : std::span(plan.missing).last(plan.missing_hidden))
        hidden_.insert({page.level, page.row, page.column});
    plan.wants_sights = !plan.missing.empty() || !store_.has_capacity() || plan.clusters.missing > 0 ||
                        (plan.clusters.on && !clusters_->has_capacity());
    if (store_.means_before() > 0) {
        plan.constants.has_means = 1;
        for (gpu::FramePage& page : plan.pages) page.means = before(page, store_.means_before());
    }
    if (store_.places_before() > 0) {
        for (gpu::FramePage& page : plan.pages) page.places = before(page, store_.places_before());
    }
    plan.constants.undulation.N_m = address_words(undulation_.address);
    plan.heights = number_;
    return {};
}

Result<Scene::Sent> Scene::send_ready(bool wait) {
    ORO_TRY(std::vector<LoadedPage> ready, loader_->take(wait));
    for (LoadedPage& page : ready) page.is_hidden = is_hidden(page.index);
    std::ranges::stable_partition(ready, [](const LoadedPage& page) { return !page.is_hidden; });
    Sent sent;
    ORO_TRY(sent.count, store_.send(ready));
    if (sent.count < ready.size()) (ready[sent.count].is_hidden ? sent.hidden_left : sent.shown_left) = true;
    return sent;
}

std::vector<PageIndex> Scene::shown_of(std::span<const PageIndex> missing) const {
    std::vector<PageIndex> shown;
    std::ranges::copy_if(missing, std::back_inserter(shown),
                         [&](const PageIndex& page) { return !is_hidden(page); });
    return shown;
}

Result<bool> Scene::advance(std::span<const PageIndex> missing) {
    bool better = false;
    for (Scene& other : beside_) {
        ORO_TRY(const bool more, other.advance(other.missed_));
        better = better || more;
    }
    if (clusters_) {
        ORO_TRY(const bool more, clusters_->advance());
        better = better || more;
    }
    if (full_) return better;
    if (full_for_hidden_)
        loader_->request(shown_of(missing));
    else
        loader_->request(missing);
    ORO_TRY(const Sent sent, send_ready(false));
    full_for_hidden_ = full_for_hidden_ || sent.hidden_left;
    full_ = sent.shown_left;
    if (full_) loader_->cancel();
    // For the next frame: what none of this one's grids uses.
    if (!beside_.empty() && std::ranges::any_of(all(), [](const Scene* scene) { return scene->full_; }))
        make_room();
    return better || sent.count > 0 || (full_ && can_give_way_);
}

// Where any grid's memory is full, what the others hold of it may be what earlier frames left.
void Scene::forget_frames() {
    const std::vector<Scene*> scenes = all();
    const bool full =
        std::ranges::any_of(scenes, [](const Scene* one) { return !one->store_.has_capacity(); });
    for (Scene* const one : scenes) {
        one->seen_ = SeenGround(*one->pages_);
        one->hidden_.clear();
        one->missed_.clear();
        one->shown_beside_.clear();
        one->full_ = one->full_for_hidden_ = one->can_give_way_ = false;
        one->means_spacing_px_ = one->asked_means_px_;
        one->loader_->cancel();
        if (!full) continue;
        one->store_.clear();
        one->store_.begin_frame();
        one->store_.release_unused();
    }
    if (clusters_) clusters_->forget_frames();
}

std::uint64_t Scene::block_bytes(const FramePlan& plan) {
    std::uint64_t bytes = 0;
    for (const PageIndex& page : plan.page_indices) bytes += store_.block_bytes(page);
    for (std::size_t i = 0; i < std::min(beside_.size(), plan.beside.size()); ++i)
        bytes += beside_[i].block_bytes(plan.beside[i]);
    return bytes;
}

std::vector<Scene*> Scene::all() {
    std::vector<Scene*> scenes{this};
    for (Scene& other : beside_) scenes.push_back(&other);
    return scenes;
}

bool Scene::make_room() {
    bool any = false;
    for (Scene* const scene : all()) any = scene->store_.release_unused() || any;
    return any;
}

Result<FramePlan> Scene::settled_plan(const Camera& camera, const Tile& tile, double tau_px,
                                      const WorldModel& model) {
    ORO_CHECK(tell_receivers(camera, tile, std::vector<FramePlan>(grids())));
    ORO_TRY(std::vector<FramePlan> plans, settled_plans(camera, tile, tau_px, model));
    if (!beside_.empty() && cast_.sun_enu) {
        // What each of them shows is known: what the others need to cast on that comes, too.
        ORO_CHECK(tell_receivers(camera, tile, plans));
        ORO_TRY(plans, settled_plans(camera, tile, tau_px, model));
    }
    return joined(std::move(plans));
}

Result<std::vector<FramePlan>> Scene::settled_plans(const Camera& camera, const Tile& tile, double tau_px,
                                                    const WorldModel& model) {
    std::vector<FramePlan> plans;
    for (Scene* const scene : all()) {
        ORO_TRY(FramePlan plan, scene->own_settled_plan(camera, tile, tau_px, model));
        if (!plan.missing.empty() && !beside_.empty()) {
            // Others may hold what earlier frames used. What this frame uses of theirs they say by a plan.
            for (Scene* const other : all())
                if (other != scene)
                    ORO_CHECK(other->own_plan(camera, tile, tau_px, model, Clusters::waited_for));
            if (make_room()) {
                ORO_TRY(plan, scene->own_settled_plan(camera, tile, tau_px, model));
            }
        }
        plans.push_back(std::move(plan));
    }
    return plans;
}

// Pages become ready in any order, so no more are asked for than there is room for. Where they differ in size
// there may be room for others then.
Result<bool> Scene::bring(std::span<const PageIndex> all_pages) {
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

Result<FramePlan> Scene::own_settled_plan(const Camera& camera, const Tile& tile, double tau_px,
                                          const WorldModel& model) {
    for (bool begun_anew = false;;) {
        ORO_TRY(FramePlan frame, own_plan(camera, tile, tau_px, model, Clusters::waited_for));
        if (frame.missing.empty()) return frame;
        ORO_TRY(bool fits, bring(shown_of(frame.missing)));
        if (!fits && can_give_way_) {
            full_ = true;  // so that the next plan lets hidden pages give way
            continue;
        }
        if (fits && frame.missing_hidden == frame.missing.size()) {
            ORO_TRY(fits, bring(frame.missing));
        }
        // What other frames left may lie so that there is room, and not in one piece.
        if (!fits && store_.has_pieces() && !std::exchange(begun_anew, true)) {
            store_.clear();
            continue;
        }
        if (!fits) return own_plan(camera, tile, tau_px, model, Clusters::waited_for);
    }
}

}  // namespace oro
