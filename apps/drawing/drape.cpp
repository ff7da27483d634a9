#include "apps/drawing/drape.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/report/progress_bar.h"
#include "geo/cover/cover_over_ground.h"
#include "geo/drape/images_over_ground.h"

namespace oro {

MemoryOptions memory_of_pages(const View& view, const MemoryOptions& memory) {
    MemoryOptions pages = memory;
    if ((!view.images.empty() || view.cover) && pages.gpu_memory_mb) *pages.gpu_memory_mb /= 2;
    return pages;
}

namespace {

// A view's images over one of a scene's grids; null where none of them lies over it.
struct OverGrid {
    std::size_t grid;
    std::unique_ptr<const GroundImage> images;
    std::unique_ptr<const CoverTiles> cover;
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
        if (outside.size() < view.images.size()) over.push_back({grid, std::move(images), nullptr});
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
        all.push_back({grid,
                       colours_over_ground(scene.grids()[grid].pages().facts().grid, grid, colours,
                                           found == over.end() ? nullptr : std::move(found->images),
                                           view.drape_opacity),
                       nullptr});
    }
    return all;
}

// Lays land cover under the images of all grids that it lies over.
Result<void> add_cover(const View& view, const Scene& scene, bool quiet, std::vector<OverGrid>& over) {
    for (const std::string& note : view.cover->notes()) say(quiet, "note: " + note);
    std::map<std::string, std::size_t> beside;  // over how many grids files do not lie
    for (std::size_t grid = 0; grid < scene.grids().size(); ++grid) {
        std::vector<std::string> outside;
        ORO_TRY(std::unique_ptr<CoverTiles> cover,
                cover_over(scene.grids()[grid].pages().facts().grid, view.cover, outside));
        for (const std::string& file : outside) ++beside[file];
        if (outside.size() == view.cover->sources().size()) continue;
        const auto found = std::ranges::find(over, grid, &OverGrid::grid);
        if (found == over.end())
            over.push_back({grid, nullptr, std::move(cover)});
        else
            found->cover = std::move(cover);
    }
    for (const auto& [file, grids] : beside)
        if (grids == scene.grids().size()) say(quiet, "note: " + file + ": lies beside the elevation data");
    return {};
}

}  // namespace

Result<void> lay_images(const View& view, const MemoryOptions& memory, const Gpu& gpu, Scene& scene,
                        bool quiet, const std::shared_ptr<const PostColours>& colours,
                        std::size_t grids_beside) {
    if ((view.images.empty() && !view.cover && !colours) || view.shows_mesh_parts) return {};
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
    if (view.cover) ORO_CHECK(add_cover(view, scene, quiet, over));
    for (OverGrid& one : over) {
        ORO_TRY(DrapeStore store,
                DrapeStore::create(gpu, std::move(one.images), look, bytes / (over.size() + grids_beside),
                                   std::move(one.cover)));
        scene.set_drape(std::make_unique<DrapeStore>(std::move(store)), one.grid);
    }
    return {};
}

}  // namespace oro
