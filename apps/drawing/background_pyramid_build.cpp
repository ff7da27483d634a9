#include "apps/drawing/background_pyramid_build.h"

#include "apps/drawing/region_scene.h"
#include "core/base/background.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

// Some 0.1 s of work on one processor (core/lod/pyramid.h).
constexpr std::size_t posts_in_a_moment = 1'000'000;
constexpr std::size_t posts_too_many_to_wait_for = 4 * posts_in_a_moment;

// Once some are asked for all are there.
Result<void> measure_means(const RegionPages& pages) {
    if (!pages.knows_means()) return {};
    const auto means = std::make_unique<gpu::PageMeans>();
    return pages.load_means({0, 0, pages.levels() - 1}, *means);
}

GridAxis every(const GridAxis& axis, int step) {
    GridAxis coarse = axis;
    coarse.posts_per_deg = axis.posts_per_deg / step;
    coarse.phase_deg = axis.at_deg(0);
    coarse.first = 0;
    coarse.count = (axis.count - 1) / step + 1;
    return coarse;
}

}  // namespace

bool measures_long(const Region& region) {
    // Of posts on a net, and of several grids, nothing coarser is made: their levels are waited for.
    const RegionGrid& first = region.grids.front();
    return region.grids.size() == 1 && !first.file && !first.field.posts && !first.field.grid.net &&
           first.field.grid.post_count() > posts_too_many_to_wait_for;
}

bool measures_means_long(const Region& region) {
    const RegionGrid& first = region.grids.front();
    return region.grids.size() == 1 && first.file &&
           first.field.grid.post_count() > posts_too_many_to_wait_for;
}

int coarse_step(const HeightField& field) {
    int step = 1;
    while (field.grid.post_count() / static_cast<std::size_t>(step * step) > posts_in_a_moment) step *= 2;
    return step;
}

HeightField coarse_field(const HeightField& field) {
    const int step = coarse_step(field);
    HeightField coarse;
    coarse.grid = {every(field.grid.lat, step), every(field.grid.lon, step)};
    coarse.undulation = field.undulation;
    coarse.H_m.reserve(coarse.grid.post_count());
    for (int row = 0; row < coarse.grid.rows(); ++row) {
        for (int column = 0; column < coarse.grid.columns(); ++column)
            coarse.H_m.push_back(field.H_at_post_m(row * step, column * step));
    }
    return coarse;
}

BackgroundPyramidBuild::BackgroundPyramidBuild(const Region& region, double exaggeration, bool means) {
    const auto measure = [this, &region, exaggeration, means] {
        auto pages = grid_pages(
            region.grids.front(), {}, exaggeration, [this](double share) { share_ = share; },
            stop_.get_token());
        if (!pages.ok() || !means || stop_.stop_requested()) return pages;
        if (const Result<void> measured = measure_means(**pages); !measured.ok()) pages = measured.error();
        return pages;
    };
    pages_ = begin_in_background(measure);
}

BackgroundPyramidBuild::~BackgroundPyramidBuild() {
    stop_.request_stop();
}

bool BackgroundPyramidBuild::ready() const {
    return is_ready(pages_);
}

Result<std::unique_ptr<RegionPages>> BackgroundPyramidBuild::wait() {
    return pages_.get();
}

}  // namespace oro
