#include "core/frame/lazy_pyramid.h"

#include <algorithm>
#include <iterator>

namespace oro {

LazyPyramid::LazyPyramid(const RegionPages& pages)
    : pages_(pages), block_(std::make_unique<gpu::PageBlock>()) {
    std::uint64_t before = 0;
    for (int level = 0; level < pages.levels(); ++level) {
        grids_.push_back(level_grid(pages.facts().grid, level));
        first_of_level_.push_back(before);
        before += grids_.back().pages().count();
    }
}

Result<void> LazyPyramid::load(const PageIndex& index, PyramidPage& page) const {
    ORO_TRY(static_cast<PageRecord&>(page), pages_.record(index));
    ORO_CHECK(pages_.load(index, *block_));
    std::copy(std::begin(block_->meshlets), std::end(block_->meshlets), page.nodes.begin());
    std::copy(std::begin(block_->boxes), std::end(block_->boxes), page.boxes.begin());
    return {};
}

const PyramidPage& LazyPyramid::page(const PageIndex& index) const {
    const std::uint64_t number = first_of_level_[static_cast<std::size_t>(index.level)] +
                                 grid(index.level).pages().number(index.row, index.column);
    std::unique_ptr<PyramidPage>& kept = kept_[number];
    if (kept) return *kept;
    kept = std::make_unique<PyramidPage>();
    if (const Result<void> loaded = load(index, *kept); !loaded.ok()) {
        if (!fault_) fault_ = loaded.error();
        *kept = {};
        // As where nothing is drawn (PageBlock): without a triangle, and good enough.
        kept->nodes.fill({gpu::vec3(0.0F), -1.0F, gpu::vec3(0.0F), 0.0F, 0.0F, -1.0F});
    }
    return *kept;
}

}  // namespace oro
