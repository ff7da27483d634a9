// What orograph sight found, as people and as programs read it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "apps/commands/sight/sight_ground.h"
#include "core/earth/world_model.h"
#include "core/sight/observer.h"
#include "geo/places/geodesic.h"

namespace oro {

struct SightReport {
    Geodetic from;
    Geodetic to;
    std::optional<MovedToSummit> moved;         // of an eye that was asked to stand on a summit
    std::optional<MovedToSummit> target_moved;  // likewise of the target
    Air air;
    GeodesicPath path{};     // over the ellipsoid
    double slant_m{};        // straight
    double elevation_deg{};  // at which the target is seen, or would be
    LineOverGround line;
    std::optional<SightHit> obstacle;  // nothing: it is seen
    double obstacle_distance_m{};      // over the ellipsoid
    // How much higher one of them would have to be; nothing: no height would do, or it is seen.
    std::optional<double> target_clearance_deficit_m;
    std::optional<double> eye_clearance_deficit_m;
    // Land cover at the eye, at the target and at the obstacle: names of classes; "" where none is known.
    std::string from_cover, to_cover, obstacle_cover;
    // How high the canopy is over the ground at the same places; nothing where there is none.
    std::optional<double> from_canopy_m, to_canopy_m, obstacle_canopy_m;
};

std::string sight_text(const SightReport& report, const SightGround& ground);
nlohmann::ordered_json sight_json(const SightReport& report, const SightGround& ground);

}  // namespace oro
