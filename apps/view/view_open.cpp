// From options, or from a view's file, to a view and its region: what shot and view begin with.
#include <utility>

#include "apps/view/view.h"

namespace oro {

void leave_geoid_out(Region& region) {
    region.geoid_left_out = std::move(region.field.undulation);
    region.field.undulation = {};
    region.geoid = "none";
}

Result<void> open_view(const std::string& view_file, const ViewOptions& view_options,
                       const RegionOptions& region_options, const Progress& progress, View& view,
                       Region& region) {
    if (!view_file.empty()) {
        ORO_TRY(view, read_view(view_file));
        ORO_CHECK(change_view(view, view_options));
        ORO_CHECK(change_region(view, region_options));
        if (view.region.paths.empty())
            return Error{ErrorKind::usage, "--view " + view_file,
                         "does not tell where its elevation data lie: name them, too"};
        ORO_TRY(region, open_region(view.region, progress));
        if (!view.has_geoid) leave_geoid_out(region);
        return {};
    }
    ORO_TRY(RegionRequest request, region_request(region_options));
    ORO_TRY(view, view_without_eye(view_options, std::move(request)));
    ORO_TRY(region, open_region(view.region, progress));
    if (!view.has_geoid) leave_geoid_out(region);
    const Result<void> placed = place_eye(view, view_options, region);
    // Ground that could not be read is no ground to stand on, but that is not why there is none.
    ORO_CHECK(region.field.health());
    return placed;
}

}  // namespace oro
