// A region's levels, measured in the background while coarser ones are shown.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/frame/region_pages.h"
#include "geo/region/region.h"

namespace oro {

// Whether measuring the levels of a region takes so long that something coarser should be shown meanwhile.
// Baked regions have theirs.
bool measures_long(const Region& region);
// Whether means of the ground (core/lod/ground_means.h) take so long that it should be shown without them
// meanwhile: those of a baked region, whose posts are all read for them.
bool measures_means_long(const Region& region);

// Every n-th post of a field that is in memory, n as large as is needed for a picture in a moment. Its posts
// are those of the field; it may end up to n - 1 posts before the field does.
HeightField coarse_field(const HeightField& field);
// That n.
int coarse_step(const HeightField& field);

class BackgroundPyramidBuild {
  public:
    // Begins to measure: levels, and means where `means` asks for them and they can be had. The region
    // outlives this. Where no thread is to be had, wait() measures.
    BackgroundPyramidBuild(const Region& region, double exaggeration, bool means);
    // Gives up what is not done.
    ~BackgroundPyramidBuild();
    BackgroundPyramidBuild(const BackgroundPyramidBuild&) = delete;
    BackgroundPyramidBuild& operator=(const BackgroundPyramidBuild&) = delete;

    [[nodiscard]] bool ready() const;
    [[nodiscard]] double share() const { return share_; }  // of the work, 0..1
    // The pages, once: waits for them. Errors: nothing to draw (no_data); a file that cannot be read.
    Result<std::unique_ptr<RegionPages>> wait();

  private:
    std::stop_source stop_;
    std::atomic<double> share_{0.0};
    std::future<Result<std::unique_ptr<RegionPages>>> pages_;
};

}  // namespace oro
