#include "render/scene/scene.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr std::uint64_t default_main_bytes = 64'000'000;

Result<Buffer> create_undulation(const Gpu& gpu, const UndulationField& field) {
    const std::size_t size = field.N_m.size() * sizeof(float);
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, size,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::upload, "undulation"));
    std::memcpy(buffer.mapped, field.N_m.data(), size);
    return buffer;
}

// Device address of what lies behind a page's block.
gpu::uvec2 behind(const gpu::FramePage& page, std::uint64_t offset) {
    return address_words((std::uint64_t{page.block.y} << 32U | page.block.x) + offset);
}

}  // namespace

std::shared_ptr<PageBudget> page_budget(const Gpu& gpu, std::uint64_t bytes) {
    constexpr std::uint64_t most = std::uint64_t{2} << 30U;
    return std::make_shared<PageBudget>(bytes > 0 ? bytes : std::min(gpu.report().memory_bytes / 2, most));
}

Result<Scene> Scene::create(const Gpu& gpu, std::unique_ptr<RegionPages> pages, const SceneMemory& memory,
                            HeightStorage heights, bool means) {
    const PageParts parts{means && pages->knows_means(), pages->facts().grid.net != nullptr};
    ORO_TRY(const HeightQuantization coding, height_quantization(*pages, heights));
    ORO_TRY(
        PageStore store,
        PageStore::create(gpu, memory.shared ? memory.shared : page_budget(gpu, memory.gpu), coding, parts));
    Scene scene(std::move(pages), std::move(store));
    static std::atomic<std::uint64_t> scenes{0};
    scene.number_ = ++scenes;
    const std::uint64_t under_way = (memory.main > 0 ? memory.main : default_main_bytes) / memory.shares;
    const std::size_t page_size = page_bytes({}, parts);
    scene.stream_ = std::make_unique<PageStream>(*scene.pages_, thread_count(), under_way / page_size, parts);
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
    ORO_TRY(FramePlan plan, own_plan(camera, tile, tau_px, model));
    for (Scene& other : beside_) {
        ORO_TRY(FramePlan more, other.own_plan(camera, tile, tau_px, model));
        other.missed_ = more.missing;
        plan.beside.push_back(std::move(more));
    }
    return plan;
}

Result<FramePlan> Scene::own_plan(const Camera& camera, const Tile& tile, double tau_px,
                                  const WorldModel& model) {
    store_.begin_frame();
    full_ = false;
    const Residency residency = [&](const PageIndex& page) { return store_.address(page); };
    ORO_TRY(FramePlan plan,
            plan_frame(*pages_, residency, camera, tile, tau_px, model, store_.coding(),
                       store_.means_offset() > 0 ? gpu::means_spacing_px : gpu::shading_spacing_px));
    if (cast_.any()) {
        if (!top_m_) {
            ORO_TRY(top_m_, region_top_m(*pages_));
        }
        ORO_CHECK(plan_casters(*pages_, residency, camera, tile, cast_, *top_m_, plan));
    }
    if (store_.means_offset() > 0) {
        plan.constants.has_means = 1;
        for (gpu::FramePage& page : plan.pages) page.means = behind(page, store_.means_offset());
    }
    if (store_.places_offset() > 0) {
        for (gpu::FramePage& page : plan.pages) page.places = behind(page, store_.places_offset());
    }
    plan.constants.undulation.N_m = address_words(undulation_.address);
    plan.heights = number_;
    return plan;
}

Result<std::size_t> Scene::send_ready(bool wait, bool& all) {
    ORO_TRY(const std::vector<LoadedPage> ready, stream_->take(wait));
    ORO_TRY(const std::size_t sent, store_.send(ready));
    bytes_sent_ += sent * page_bytes(store_.coding());
    all = sent == ready.size();
    return sent;
}

Result<bool> Scene::advance(std::span<const PageIndex> missing) {
    bool better = false;
    for (Scene& other : beside_) {
        ORO_TRY(const bool more, other.advance(other.missed_));
        better = better || more;
    }
    if (full_) return better;
    stream_->want(missing);
    bool fits = true;
    ORO_TRY(const std::size_t sent, send_ready(false, fits));
    full_ = !fits;
    if (full_) stream_->want({});
    // For the next frame: what none of this one's grids uses.
    if (!beside_.empty() && std::ranges::any_of(all(), [](const Scene* scene) { return scene->full_; }))
        make_room();
    return better || sent > 0;
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
    std::vector<FramePlan> plans;
    for (Scene* const scene : all()) {
        ORO_TRY(FramePlan plan, scene->own_settled_plan(camera, tile, tau_px, model));
        if (!plan.missing.empty() && !beside_.empty()) {
            // Others may hold what earlier frames used. What this frame uses of theirs they say by a plan.
            for (Scene* const other : all())
                if (other != scene) ORO_CHECK(other->own_plan(camera, tile, tau_px, model));
            if (make_room()) {
                ORO_TRY(plan, scene->own_settled_plan(camera, tile, tau_px, model));
            }
        }
        plans.push_back(std::move(plan));
    }
    FramePlan plan = std::move(plans.front());
    plan.beside.assign(std::make_move_iterator(plans.begin() + 1), std::make_move_iterator(plans.end()));
    return plan;
}

Result<FramePlan> Scene::own_settled_plan(const Camera& camera, const Tile& tile, double tau_px,
                                          const WorldModel& model) {
    for (;;) {
        ORO_TRY(FramePlan frame, own_plan(camera, tile, tau_px, model));
        if (frame.missing.empty()) return frame;
        stream_->want(frame.missing);
        for (std::size_t sent = 0; sent < frame.missing.size();) {
            bool all = true;
            ORO_TRY(const std::size_t some, send_ready(true, all));
            sent += some;
            if (all && some > 0) continue;
            if (all) break;
            stream_->want({});
            return own_plan(camera, tile, tau_px, model);
        }
    }
}

}  // namespace oro
