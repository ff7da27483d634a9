// Heights of the ground along a way.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/sight/edge_crossings.h"
#include "core/truth/true_ground.h"

namespace oro {

struct ProfilePoint {
    double along_m{};  // from the way's begin
    double lat_deg{};
    double lon_deg{};
    bool has_ground{};  // false beyond the data and over void posts: the heights say nothing
    double H_m{};
    double h_m{};
};

// Told how far along the way the points are. What it throws ends the work, and is thrown to the caller.
using ProfileProgress = std::function<void(double along_m)>;

// Appends the points of a way from from_m to to_m, its begin and its end among them (the begin only where
// `points` is empty): each place where it crosses an edge of the ground's triangles, and both sides of the
// rim of a grid (edge_crossings). Between two neighbours h is linear in latitude and longitude. `way` gives
// places by along_m; its heights do not count.
void add_profile(const TrueGround& ground, const Way& way, double from_m, double to_m,
                 std::vector<ProfilePoint>& points, const ProfileProgress& progress = {});

ProfilePoint profile_point(const TrueGround& ground, const Geodetic& place, double along_m);

// What a profile comes to.
struct ProfileSums {
    double ascent_m{};   // of H, from point to point where both have ground
    double descent_m{};  // 0 or more
    // The ascent and descent by rises and falls of climb_threshold_m or more alone (climb_over()).
    double climb_threshold_m{};
    double climbed_m{};
    double went_down_m{};
    // Numbers of the first of the highest and of the lowest points; nothing where none has ground.
    std::optional<std::size_t> highest, lowest;
    double without_data_m{};  // between points of which one has no ground
};
// `climb_threshold_m`: 0 or more.
ProfileSums sums_of(const std::vector<ProfilePoint>& points, double climb_threshold_m);

// How far a line climbs and goes down as guides and receivers count it: the line turns where it has come back
// by the threshold or more from its highest (lowest) place since its last turn, and each way between two
// turns counts whole. What goes up and down by less is left out. Of a line in parts, each by itself.
struct Climb {
    double up_m{};
    double down_m{};  // 0 or more
};
Climb climb_over(const std::vector<ProfilePoint>& points, double threshold_m);

}  // namespace oro
