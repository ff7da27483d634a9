#include "apps/drawing/drape.h"

#include <algorithm>
#include <optional>
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

namespace {

// A view's images over one of a scene's grids; null where none of them lies over it.
struct OverGrid {
    std::size_t grid;
    std::unique_ptr<const GroundImage> images;
};

// Over which grids there are some. A file that lies beside all of them is named, unless `quiet`.
Result<std::vector<OverGrid>> over_grids(const View& view, const Scene& scene, bool quiet) {
    std::vector<OverGrid> over;
    std::optional<std::vector<std::string>> outside_all;
    for (std::size_t grid = 0; grid < scene.grids().size(); ++grid) {
        std::vector<std::string> outside;
        ORO_TRY(std::unique_ptr<GroundImage> images,
                images_over(scene.grids()[grid].pages().facts().grid, view.images, outside));
        if (!outside_all) outside_all = outside;
        std::erase_if(*outside_all, [&](const std::string& file) {
            return std::ranges::find(outside, file) == outside.end();
        });
        if (outside.size() < view.images.size()) over.push_back({grid, std::move(images)});
    }
    for (const std::string& file : *outside_all)
        say(quiet, "note: " + file + ": lies beside the elevation data");
    return over;
}

// Colours over all grids, and over the images that lie there.
std::vector<OverGrid> with_colours(std::vector<OverGrid> over, const View& view, const Scene& scene,
                                   const std::shared_ptr<const PostColours>& colours) {
    std::vector<OverGrid> all;
    for (std::size_t grid = 0; grid < scene.grids().size(); ++grid) {
        const auto found = std::ranges::find(over, grid, &OverGrid::grid);
        all.push_back({grid, colours_over_ground(scene.grids()[grid].pages().facts().grid, grid, colours,
                                                 found == over.end() ? nullptr : std::move(found->images),
                                                 view.drape_opacity)});
    }
    return all;
}

}  // namespace

Result<void> lay_images(const View& view, const MemoryOptions& memory, const Gpu& gpu, Scene& scene,
                        bool quiet, const std::shared_ptr<const PostColours>& colours) {
    if (view.images.empty() && !colours) return {};
    for (const ImageSource& image : view.images) {
        for (const std::string& note : image.notes) say(quiet, "note: " + note);
    }
    ORO_TRY(std::vector<OverGrid> over, over_grids(view, scene, quiet));
    constexpr std::uint64_t most = std::uint64_t{1} << 30U;
    const std::uint64_t bytes = memory.gpu_memory_mb
                                    ? static_cast<std::uint64_t>(*memory.gpu_memory_mb) * 500000U
                                    : std::min(gpu.report().memory_bytes / 4, most);
    DrapeLook look;
    // Under colours images have their opacity already.
    look.opacity = colours ? 1.0F : static_cast<float>(view.drape_opacity);
    if (colours) over = with_colours(std::move(over), view, scene, colours);
    for (OverGrid& one : over) {
        ORO_TRY(DrapeStore store, DrapeStore::create(gpu, std::move(one.images), look, bytes / over.size()));
        scene.set_drape(std::make_unique<DrapeStore>(std::move(store)), one.grid);
    }
    return {};
}

}  // namespace oro
