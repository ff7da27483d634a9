#include "apps/window/region_opening.h"

#include <memory>
#include <utility>

#include "apps/window/kept_view.h"
#include "apps/window/window_start.h"
#include "core/base/background.h"

namespace oro {

RegionOpening::RegionOpening(WindowOptions options, std::optional<Project> project) {
    OpenedRegion asked;
    asked.options = std::move(options);
    asked.project = std::move(project);
    name_ = name_of_paths(asked.paths());
    const auto begun = std::make_shared<OpenedRegion>(std::move(asked));
    const auto work = [this, begun] { return read(std::move(*begun)); };
    opened_ = begin_in_background(work);
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
    return is_ready(opened_);
}

Result<OpenedRegion> RegionOpening::wait() {
    return opened_.get();
}

Result<OpenedRegion> RegionOpening::read(OpenedRegion opened) {
    if (opened.project) opened.view = opened.project->view;
    const bool with_canopy = !opened.options.view.canopy.empty();
    ORO_CHECK(open_other_region(
        opened.options, [this](double share, const std::string& what) { tell(share, what); }, opened.view,
        opened.region));
    opened.canopy_left_out = with_canopy && opened.options.view.canopy.empty();
    ORO_TRY(opened.cuts, cut_regions(opened.region));
    ORO_TRY(opened.pages, first_pages(opened.region, opened.cuts, opened.view,
                                      [this](double share) { tell(share, "measuring levels"); }));
    return opened;
}

}  // namespace oro
