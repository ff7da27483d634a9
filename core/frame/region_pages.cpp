#include "core/frame/region_pages.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "core/terrain/page_diagonals.h"
#include "core/terrain/page_on_net.h"

namespace oro {
namespace {

class PagesInMemory : public RegionPages {
  public:
    PagesInMemory(RegionFacts facts, LevelPyramid pyramid, DrawnHeights heights,
                  std::shared_ptr<const DataMeans> data_means)
        : RegionPages(std::move(facts)),
          pyramid_(std::move(pyramid)),
          heights_(std::move(heights)),
          data_means_(std::move(data_means)) {}

    [[nodiscard]] Result<PageRecord> record(const PageIndex& page) const override {
        return PageRecord(at(page));
    }

    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        const PageHeights heights = page_heights(facts().grid, heights_, page);
        std::ranges::copy(heights.sw_ne, std::begin(block.sw_ne));
        std::copy(heights.steps.begin(), heights.steps.end(), std::begin(block.heights));
        put_nodes(page, block);
        return {};
    }
    Result<void> load_without_heights(const PageIndex& page, gpu::PageBlock& block) const override {
        std::ranges::copy(page_diagonals(heights_, page), std::begin(block.sw_ne));
        put_nodes(page, block);
        return {};
    }

    [[nodiscard]] bool knows_means() const override { return true; }
    Result<void> load_means(const PageIndex& page, gpu::PageMeans& means) const override {
        if (data_means_) {
            data_means_->page(page, means);
            return {};
        }
        std::call_once(means_made_, [&] {
            means_.emplace(facts().grid, heights_, facts().shape.exaggeration, thread_count());
        });
        means_->page(page, means);
        return {};
    }

  private:
    [[nodiscard]] const PyramidPage& at(const PageIndex& page) const {
        return pyramid_.levels[static_cast<std::size_t>(page.level)].page(page.row, page.column);
    }

    void put_nodes(const PageIndex& page, gpu::PageBlock& block) const {
        const PyramidPage& built = at(page);
        std::copy(built.nodes.begin(), built.nodes.end(), std::begin(block.meshlets));
        std::copy(built.boxes.begin(), built.boxes.end(), std::begin(block.boxes));
        set_spacing(facts().grid, built.summary, block);
    }

    LevelPyramid pyramid_;
    DrawnHeights heights_;
    std::shared_ptr<const DataMeans> data_means_;  // null: its own
    mutable std::once_flag means_made_;
    mutable std::optional<GroundMeans> means_;
};

}  // namespace

RegionPages::RegionPages(RegionFacts facts)
    : facts_(std::move(facts)),
      levels_(level_count(facts_.grid)),
      wraps_longitude_(facts_.grid.wraps_longitude()) {}

RegionPages::RegionPages(RegionFacts facts, int levels)
    : facts_(std::move(facts)), levels_(levels), wraps_longitude_(facts_.grid.wraps_longitude()) {}

Result<void> RegionPages::load_means(const PageIndex&, gpu::PageMeans&) const {
    return Error{ErrorKind::failed, "pages", "no means are known of these"};
}

Result<void> RegionPages::load_words(const PageIndex&, std::vector<std::uint32_t>&) const {
    return Error{ErrorKind::failed, "pages", "these have no words of their own"};
}

Result<void> RegionPages::load_places(const PageIndex& page, const gpu::PageBlock& block,
                                      gpu::PagePlaces& places) const {
    ORO_TRY(const PageRecord whole, record(page));
    PageHeights heights;
    std::copy(std::begin(block.heights), std::end(block.heights), heights.steps.begin());
    if (fill_places(facts_.grid, whole.summary, heights, places)) return {};
    return Error{
        ErrorKind::failed, "region too large",
        "its own posts lie more than 1,048 km from the plane of one page; open a part of it (--bbox)"};
}

std::unique_ptr<RegionPages> pages_in_memory(const HeightField& field, double exaggeration, int threads,
                                             const std::function<void(double share)>& progress,
                                             const std::stop_token& stop) {
    return pages_beside_detail(field, exaggeration, {}, threads, progress, stop);
}

std::unique_ptr<RegionPages> pages_beside_detail(const HeightField& field, double exaggeration,
                                                 std::shared_ptr<const DataMeans> means, int threads,
                                                 const std::function<void(double share)>& progress,
                                                 const std::stop_token& stop) {
    RegionFacts facts{field.grid, field.grid.net ? drawn_undulation(field) : field.undulation,
                      region_shape(field, exaggeration), 0};
    DrawnHeights heights = drawn_heights(field, exaggeration, threads);
    std::uint64_t all = 0;
    for (int level = 0; level < level_count(field.grid); ++level) {
        all += level_grid(field.grid, level).pages().count();
    }
    std::uint64_t done = 0;
    PyramidHooks hooks;
    hooks.sink = [&](int, const PyramidPage& page, const gpu::PageBlock&,
                     const StitchedDeviations&) -> Result<void> {
        if (stop.stop_requested()) return Error{ErrorKind::failed, "levels", "nobody wants them any more"};
        if (page.summary.index.level == 0) facts.triangles += page.summary.triangles;
        ++done;
        if (progress) progress(static_cast<double>(done) / static_cast<double>(all));
        return {};
    };
    Result<LevelPyramid> pyramid = build_pyramid_with(field.grid, facts.shape, heights, threads, hooks);
    if (!pyramid.ok()) return nullptr;
    return std::make_unique<PagesInMemory>(std::move(facts), std::move(pyramid).value(), std::move(heights),
                                           std::move(means));
}

}  // namespace oro
