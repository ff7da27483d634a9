#include "apps/commands/sight/sight_between.h"

#include "apps/commands/sight/look_along.h"
#include "core/sight/observer.h"

namespace oro {
namespace {

// An eye in a canopy sees nothing, whatever line leads out of it: the leaves before it hide all.
void hide_in_canopy(const SightGround& ground, SightReport& report) {
    const std::optional<double> below_m = ground.in_canopy_m(report.from);
    if (!below_m) return;
    report.obstacle = SightHit{};
    report.obstacle->point = report.from;
    report.obstacle_distance_m = 0.0;
    report.target_clearance_deficit_m.reset();
    Geodetic over = report.from;
    over.h_m += *below_m + least_above_m;
    report.eye_clearance_deficit_m = eye_clearance_deficit_m(ground.hiding(), over, report.air, report.to);
    if (report.eye_clearance_deficit_m) *report.eye_clearance_deficit_m += over.h_m - report.from.h_m;
}

// What grows at the places that are told of, and whether it is what hides.
void measure_canopy(const SightGround& ground, SightReport& report) {
    if (!ground.canopy) return;
    hide_in_canopy(ground, report);
    report.from_canopy_m = ground.canopy_m(report.from);
    report.to_canopy_m = ground.canopy_m(report.to);
    if (report.obstacle) report.obstacle_canopy_m = ground.canopy_m(report.obstacle->point);
}

}  // namespace

SightReport sight_between(const Geodetic& from, const Geodetic& to, const Air& air,
                          const SightGround& ground) {
    SightReport report = look_along(from, to, air, ground.hiding());
    measure_canopy(ground, report);
    return report;
}

}  // namespace oro
