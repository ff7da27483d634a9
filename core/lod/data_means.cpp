#include "core/lod/data_means.h"

#include <utility>

#include "core/base/parallel.h"

namespace oro {

DataMeans::DataMeans(PostGrid grid, DrawnHeights heights, double exaggeration)
    : grid_(std::move(grid)), heights_(std::move(heights)), exaggeration_(exaggeration) {}

void DataMeans::page(const PageIndex& index, gpu::PageMeans& means) const {
    std::call_once(made_, [this] { means_.emplace(grid_, heights_, exaggeration_, thread_count()); });
    means_->page(index, means);
}

}  // namespace oro
