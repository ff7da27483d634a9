#include "apps/window/measuring.h"

#include <algorithm>
#include <memory>

namespace oro {
namespace {

// Measures the line anew, and finds where its picture goes: on the ground, a little over it.
Result<void> measure(Viewer& viewer, const std::vector<LatLon>& places) {
    constexpr std::size_t most_points = 400;
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    Measuring& measuring = viewer.measuring;
    // Figures are those of heights as they are; what is drawn lies on those that are shown.
    std::unique_ptr<const RegionGround> as_it_is;
    if (viewer.view.exaggeration != 1.0) {
        ORO_TRY(as_it_is, RegionGround::of(viewer.region, viewer.cuts, 1.0));
    }
    Result<Measurement> found =
        measured(places, viewer.view.model.air, (as_it_is ? *as_it_is : *ground).ground());
    if (!found.ok()) {
        // Such as a place twice.
        tell(viewer, found.error());
        return ground->ground().health();
    }
    measuring.found = std::move(*found);
    measuring.line_ecef.clear();
    measuring.corners_ecef.clear();
    const auto on_ground = [&](double lat_deg, double lon_deg) {
        const double h_m = ground->ground().h_m(lat_deg, lon_deg).value_or(0.0);
        return ecef_from_geodetic({lat_deg, lon_deg, h_m});
    };
    for (const LatLon& place : places)
        measuring.corners_ecef.push_back(on_ground(place.lat_deg, place.lon_deg));
    if (!measuring.found.profile) return {};
    const auto& points = measuring.found.profile->points;
    const std::size_t every = std::max<std::size_t>(1, points.size() / most_points);
    for (std::size_t i = 0; i < points.size(); i += every)
        measuring.line_ecef.push_back(on_ground(points[i].lat_deg, points[i].lon_deg));
    measuring.line_ecef.push_back(measuring.corners_ecef.back());
    return {};
}

}  // namespace

Result<void> add_place(Viewer& viewer, glm::dvec2 point_px) {
    ORO_TRY(const auto seen, seen_at(viewer, point_px));
    if (!seen) {
        tell(viewer, line_of(seen));
        return {};
    }
    std::vector<LatLon> places = viewer.measuring.found.places;
    places.push_back({seen->lat_deg, seen->lon_deg});
    return measure(viewer, places);
}

Result<void> take_back_place(Viewer& viewer) {
    std::vector<LatLon> places = viewer.measuring.found.places;
    if (!places.empty()) places.pop_back();
    return measure(viewer, places);
}

Result<void> measure_places(Viewer& viewer, const std::vector<LatLon>& places) {
    return measure(viewer, places);
}

Result<void> clear_places(Viewer& viewer) {
    return measure(viewer, {});
}

}  // namespace oro
