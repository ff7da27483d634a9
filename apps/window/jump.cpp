#include "apps/window/jump.h"

#include <cmath>

#include "apps/eye/standpoint.h"
#include "apps/navigation/flight_step.h"
#include "apps/view/place_camera.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

constexpr double usual_above_m = 2.0;

const HeightField& field_under(const Region& region, const Geodetic& place) {
    return grid_at(region, place.lat_deg, place.lon_deg).field;
}

// The same line of sight, turned as the user asked for.
Attitude users_attitude(const Attitude& attitude, double roll_deg) {
    return {picture_top_deg(attitude, roll_deg), attitude.pitch_deg, roll_deg};
}

}  // namespace

double users_roll_deg(const Camera& camera, const std::optional<double>& option_deg) {
    if (option_deg) return *option_deg;
    return std::abs(camera.attitude.pitch_deg) < steep_pitch_deg ? camera.attitude.roll_deg : 0.0;
}

Result<Camera> Jumps::to(const Camera& camera, const Place& place, const Region& region, double exaggeration,
                         const std::string& typed) {
    stay();
    Camera there = camera;
    there.attitude = users_attitude(camera.attitude, roll_deg_);
    const double heading_deg = heading_deg_.value_or(there.attitude.heading_deg);
    if (place.height_m) {
        there.eye = {place.lat_deg, place.lon_deg, *place.height_m};
        there = above_ground(there, field_under(region, there.eye), exaggeration);
    } else {
        AskedLine asked;
        asked.usual_heading_deg = heading_deg;
        const std::string name =
            place.cell && !typed.empty() ? typed : place_name(place.lat_deg, place.lon_deg);
        ORO_TRY(there, camera_showing(there, place, asked, region, exaggeration, name));
    }
    shown_ = place;
    heading_deg_ = heading_deg;
    return there;
}

Result<std::optional<Camera>> Jumps::stand(const Camera& camera, const Region& region, double exaggeration) {
    Camera there = camera;
    std::optional<MovedToSummit> higher;
    if (higher_) {
        there.eye = higher_->to;
    } else if (shown_ && !shown_->height_m) {
        const Geodetic place{shown_->lat_deg, shown_->lon_deg, 0.0};
        const HeightField& field = field_under(region, place);
        const auto ground_m = ground_h_m(field, place.lat_deg, place.lon_deg, exaggeration);
        if (ground_m) higher = moved_to_summit(place, region, exaggeration);
        ORO_CHECK(region.health());
        if (!ground_m)
            return Error{ErrorKind::no_data, place_name(place.lat_deg, place.lon_deg),
                         "no elevation data there to stand on"};
        there.eye = {place.lat_deg, place.lon_deg, *ground_m};
    } else {
        return std::optional<Camera>();
    }
    there.eye.h_m += usual_above_m;
    there.attitude = users_attitude(camera.attitude, roll_deg_);
    there.attitude.pitch_deg = 0.0;
    stay();
    if (higher && higher->moved_m > 0.0) higher_ = higher;
    return std::optional(there);
}

void Jumps::moved() {
    stay();
    heading_deg_.reset();
}

void Jumps::stay() {
    shown_.reset();
    higher_.reset();
}

}  // namespace oro
