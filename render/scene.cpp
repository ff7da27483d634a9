#include "render/scene.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <thread>

#include "core/parallel.h"

namespace oro {
namespace {

constexpr std::size_t pages_at_a_time = 64;  // 5 MB on their way

int thread_count() {
    return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
}

Result<Buffer> create_undulation(const Gpu& gpu, const UndulationField& field) {
    const std::size_t size = field.N_m.size() * sizeof(float);
    ORO_TRY(Buffer buffer,
            create_buffer(gpu, size,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          BufferPlace::upload, "undulation"));
    std::memcpy(buffer.mapped, field.N_m.data(), size);
    return buffer;
}

}  // namespace

Result<Scene> Scene::create(const Gpu& gpu, std::unique_ptr<RegionPages> pages,
                            std::uint64_t gpu_memory_bytes) {
    constexpr std::uint64_t most = std::uint64_t{2} << 30U;
    const std::uint64_t bytes =
        gpu_memory_bytes > 0 ? gpu_memory_bytes : std::min(gpu.report().memory_bytes / 2, most);
    ORO_TRY(PageStore store, PageStore::create(gpu, bytes / sizeof(gpu::PageBlock)));
    Scene scene(std::move(pages), std::move(store));
    const UndulationField& undulation = scene.pages_->facts().undulation;
    if (!undulation.N_m.empty()) {
        ORO_TRY(scene.undulation_, create_undulation(gpu, undulation));
    }
    return scene;
}

Result<FramePlan> Scene::plan(const Camera& camera, const Tile& tile, double tau_px) {
    store_.begin_frame();
    ORO_TRY(FramePlan plan,
            plan_frame(
                *pages_, [&](const PageIndex& page) { return store_.address(page); }, camera, tile, tau_px));
    plan.constants.undulation.N_m = address_words(undulation_.address);
    return plan;
}

// Builds pages and sends them; how many there was room for.
Result<std::size_t> Scene::load(std::span<const PageIndex> wanted) {
    std::size_t sent = 0;
    while (sent < wanted.size()) {
        const auto some = wanted.subspan(sent, std::min(pages_at_a_time, wanted.size() - sent));
        std::vector<LoadedPage> loaded(some.size());
        std::vector<std::optional<Error>> failed(some.size());
        in_parallel(static_cast<int>(some.size()), thread_count(), [&](int number) {
            const auto i = static_cast<std::size_t>(number);
            loaded[i] = {some[i], std::make_unique<gpu::PageBlock>()};
            const Result<void> done = pages_->load(some[i], *loaded[i].block);
            if (!done.ok()) failed[i] = done.error();
        });
        for (const std::optional<Error>& error : failed) {
            if (error) return *error;
        }
        ORO_TRY(const std::size_t count, store_.send(loaded));
        bytes_sent_ += count * sizeof(gpu::PageBlock);
        sent += count;
        if (count < some.size()) break;
    }
    return sent;
}

Result<FramePlan> Scene::settled_plan(const Camera& camera, const Tile& tile, double tau_px) {
    for (;;) {
        ORO_TRY(FramePlan frame, plan(camera, tile, tau_px));
        if (frame.missing.empty()) return frame;
        ORO_TRY(const std::size_t sent, load(frame.missing));
        if (sent < frame.missing.size()) return plan(camera, tile, tau_px);
    }
}

}  // namespace oro
