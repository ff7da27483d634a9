#include "apps/commands/sight/profile_roofs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/report/feature_words.h"
#include "core/base/one_line.h"
#include "geo/together/mesh_roofs.h"

namespace oro {
namespace {

ProfilePoint point_between(const SightGround& ground, const ProfilePoint& from, const ProfilePoint& to,
                           double along_m) {
    const double share = (along_m - from.along_m) / (to.along_m - from.along_m);
    return profile_point(
        ground.ground(),
        {std::lerp(from.lat_deg, to.lat_deg, share),
         normalised_lon_deg(from.lon_deg + share * std::remainder(to.lon_deg - from.lon_deg, 360.0)), 0.0},
        along_m);
}

std::vector<ProfilePoint> with_sides(const SightGround& ground, const MeshRoofs& roofs,
                                     const std::vector<ProfilePoint>& points) {
    std::vector<ProfilePoint> more;
    for (std::size_t i = 0; i < points.size(); ++i) {
        more.push_back(points[i]);
        if (i + 1 == points.size()) break;
        const ProfilePoint &from = points[i], &to = points[i + 1];
        for (const double share :
             roofs.sides_crossed({from.lat_deg, from.lon_deg}, {to.lat_deg, to.lon_deg})) {
            constexpr double beside_m = 0.5e-3;
            for (const double side_m : {-beside_m, beside_m}) {
                const double along_m = std::lerp(from.along_m, to.along_m, share) + side_m;
                if (along_m > more.back().along_m && along_m < to.along_m)
                    more.push_back(point_between(ground, from, to, along_m));
            }
        }
    }
    return more;
}

}  // namespace

void add_roofs(const SightGround& ground, bool as_asked, Profile& profile) {
    if (!ground.region.meshes) return;
    const MeshRoofs roofs(ground.region, ground.ground().exaggeration());
    if (!as_asked) profile.points = with_sides(ground, roofs, profile.points);
    profile.roofs.clear();
    for (const ProfilePoint& point : profile.points) {
        ProfileRoof& top = profile.roofs.emplace_back();
        const auto found = roofs.at(point.lat_deg, point.lon_deg);
        if (!found || (point.has_ground && found->h_m <= point.h_m)) continue;
        top.is_there = true;
        top.h_m = found->h_m;
        top.H_m = found->h_m - ground.ground().N_m(point.lat_deg, point.lon_deg);
        const PlacedMesh& mesh = ground.grids->mesh(found->mesh);
        top.on = found->feature > 0 ? words_of(mesh.features[found->feature - 1])
                                    : one_line(std::filesystem::path(mesh.path).filename().string());
    }
}

std::optional<std::size_t> highest_top(const Profile& profile) {
    std::optional<std::size_t> highest;
    for (std::size_t i = 0; i < profile.roofs.size(); ++i)
        if (profile.roofs[i].is_there && (!highest || profile.roofs[i].H_m > profile.roofs[*highest].H_m))
            highest = i;
    return highest;
}

double over_meshes_m(const Profile& profile) {
    double sum_m = 0.0;
    for (std::size_t i = 1; i < profile.roofs.size(); ++i)
        if (profile.roofs[i - 1].is_there && profile.roofs[i].is_there)
            sum_m += profile.points[i].along_m - profile.points[i - 1].along_m;
    return sum_m;
}

}  // namespace oro
