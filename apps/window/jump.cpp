#include "apps/window/jump.h"

#include "apps/eye/place_camera.h"
#include "apps/eye/standpoint.h"
#include "apps/window/flight.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

const HeightField& field_under(const Region& region, const Geodetic& place) {
    return region_at(region, place.lat_deg, place.lon_deg).field;
}

}  // namespace

Result<Camera> Jumps::to(const Camera& camera, const Place& place, const Region& region,
                         double exaggeration) {
    Camera there = camera;
    if (place.height_m) {
        there.eye = {place.lat_deg, place.lon_deg, *place.height_m};
        there = above_ground(there, field_under(region, there.eye), exaggeration);
    } else {
        AskedLine asked;
        asked.usual_heading_deg = camera.attitude.heading_deg;
        ORO_TRY(there, camera_showing(camera, place, asked, region, exaggeration,
                                      place_name(place.lat_deg, place.lon_deg)));
    }
    before_.push_back(camera);
    shown_ = place;
    return there;
}

Result<std::optional<Camera>> Jumps::stand(const Camera& camera, const Region& region, double exaggeration) {
    if (!shown_ || shown_->height_m) return std::optional<Camera>();
    const Geodetic place{shown_->lat_deg, shown_->lon_deg, 0.0};
    const auto ground_m = ground_h_m(field_under(region, place), place.lat_deg, place.lon_deg, exaggeration);
    ORO_CHECK(region.health());
    if (!ground_m)
        return Error{ErrorKind::no_data, place_name(place.lat_deg, place.lon_deg),
                     "no elevation data there to stand on"};
    constexpr double usual_above_m = 2.0;
    Camera there = camera;
    there.eye = {place.lat_deg, place.lon_deg, *ground_m + usual_above_m};
    there.attitude.pitch_deg = 0.0;
    before_.push_back(camera);
    shown_.reset();
    return std::optional(there);
}

std::optional<Camera> Jumps::back(const Camera& camera) {
    if (before_.empty()) return std::nullopt;
    Camera there = before_.back();
    before_.pop_back();
    there.width_px = camera.width_px;
    there.height_px = camera.height_px;
    shown_.reset();
    return there;
}

}  // namespace oro
