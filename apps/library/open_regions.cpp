#include "apps/library/open_regions.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "apps/commands/info_json.h"
#include "apps/library/guarded_call.h"
#include "apps/view/view.h"
#include "geo/opening/open_region.h"

namespace oro {
namespace {

class OpenRegions {
  public:
    oro_region add(std::shared_ptr<const OpenRegion> region) {
        const std::lock_guard lock(mutex_);
        const oro_region number = next_;
        regions_.emplace(number, std::move(region));
        ++next_;
        return number;
    }
    // Null for none.
    std::shared_ptr<const OpenRegion> find(oro_region number) {
        const std::lock_guard lock(mutex_);
        const auto found = regions_.find(number);
        return found == regions_.end() ? nullptr : found->second;
    }
    // What was under the number: it is destroyed by who gets it, and not under the lock.
    std::shared_ptr<const OpenRegion> take(oro_region number) {
        const std::lock_guard lock(mutex_);
        const auto found = regions_.find(number);
        if (found == regions_.end()) return nullptr;
        std::shared_ptr<const OpenRegion> region = std::move(found->second);
        regions_.erase(found);
        return region;
    }

  private:
    std::mutex mutex_;
    oro_region next_{1};
    std::unordered_map<oro_region, std::shared_ptr<const OpenRegion>> regions_;
};

// It is never destroyed: threads of the process may ask while that ends.
OpenRegions& open_regions() {
    static auto& regions = *new OpenRegions;
    return regions;
}

Error not_open(oro_region number) {
    return bad_argument("region", std::to_string(number) + " is not open");
}

}  // namespace

Result<std::shared_ptr<const OpenRegion>> open_for_library(const RegionOptions& options,
                                                           const ViewOptions& cover,
                                                           const Progress& progress) {
    auto open = std::make_shared<OpenRegion>();
    open->options = options;
    open->cover = cover;
    ORO_TRY(open->request, region_request(options));
    ORO_TRY(const SightCover covers, open_sight_cover(cover));
    ORO_TRY(Region region, open_region(open->request, progress));
    Region listed = region;
    leave_listed_notes_out(listed);
    open->info = info_json(listed, false);
    listed = {};
    const std::size_t grids = region.grids.size();
    if (grids > 1) open->as_opened = region;
    ORO_TRY(open->ground, sight_ground_of(std::move(region), covers));
    if (open->ground->region.grids.size() == grids) open->as_opened.reset();
    return std::shared_ptr<const OpenRegion>(std::move(open));
}

oro_region keep_open(std::shared_ptr<const OpenRegion> region) {
    return open_regions().add(std::move(region));
}

Result<std::shared_ptr<const OpenRegion>> region_of(oro_region number) {
    std::shared_ptr<const OpenRegion> region = open_regions().find(number);
    if (!region) return not_open(number);
    return region;
}

Result<void> close_region(oro_region number) {
    if (!open_regions().take(number)) return not_open(number);
    return {};
}

}  // namespace oro
