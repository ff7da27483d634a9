#include "apps/drawing/drape.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/progress_bar.h"
#include "geo/drape/images_over_ground.h"

namespace oro {

MemoryOptions memory_of_pages(const View& view, const MemoryOptions& memory) {
    MemoryOptions pages = memory;
    if (!view.images.empty() && pages.gpu_memory_mb) *pages.gpu_memory_mb /= 2;
    return pages;
}

Result<void> lay_images(const View& view, const Region& region, const MemoryOptions& memory, const Gpu& gpu,
                        Scene& scene, bool quiet) {
    if (view.images.empty()) return {};
    for (const ImageSource& image : view.images) {
        for (const std::string& note : image.notes) say(quiet, "note: " + note);
    }
    std::vector<std::string> beside;
    ORO_TRY(std::unique_ptr<GroundImage> over, images_over(region.field.grid, view.images, beside));
    for (const std::string& file : beside) say(quiet, "note: " + file + ": lies beside the elevation data");
    constexpr std::uint64_t most = std::uint64_t{1} << 30U;
    const std::uint64_t bytes = memory.gpu_memory_mb
                                    ? static_cast<std::uint64_t>(*memory.gpu_memory_mb) * 500000U
                                    : std::min(gpu.report().memory_bytes / 4, most);
    DrapeLook look;
    look.opacity = static_cast<float>(view.drape_opacity);
    ORO_TRY(DrapeStore store, DrapeStore::create(gpu, std::move(over), look, bytes));
    scene.set_drape(std::make_unique<DrapeStore>(std::move(store)));
    return {};
}

}  // namespace oro
