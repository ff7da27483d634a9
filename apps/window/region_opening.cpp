#include "apps/window/region_opening.h"

#include <chrono>
#include <system_error>
#include <utility>

#include "apps/window/window_start.h"

namespace oro {

RegionOpening::RegionOpening(WindowOptions options) : name_(name_of_paths(options.region.paths)) {
    const auto work = [this, options = std::move(options)] { return read(options); };
    try {
        opened_ = std::async(std::launch::async, work);
    } catch (const std::system_error&) {
        opened_ = std::async(std::launch::deferred, work);
    }
}

void RegionOpening::tell(double share, const std::string& step) {
    share_ = share;
    const std::scoped_lock lock(mutex_);
    step_ = step;
}

std::string RegionOpening::step() const {
    const std::scoped_lock lock(mutex_);
    return step_;
}

bool RegionOpening::ready() const {
    return opened_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
}

Result<OpenedRegion> RegionOpening::wait() {
    return opened_.get();
}

Result<OpenedRegion> RegionOpening::read(const WindowOptions& options) {
    OpenedRegion opened;
    opened.options = options;
    ORO_CHECK(open_flight(
        options, [this](double share, const std::string& what) { tell(share, "reading " + what); },
        opened.view, opened.region));
    ORO_TRY(opened.cuts, cut_regions(opened.region));
    ORO_TRY(opened.pages, first_pages(opened.region, opened.cuts, opened.view,
                                      [this](double share) { tell(share, "measuring levels"); }));
    return opened;
}

}  // namespace oro
