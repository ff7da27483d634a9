#include "core/cluster_file/group_growth.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <sstream>

namespace oro {
namespace {

// All digits that a distance has.
std::string all_digits_m(double value_m) {
    std::ostringstream text;
    text.precision(17);
    text << value_m << " m";
    return text.str();
}

std::optional<std::string> beyond_radius(double reach_m, double radius_m) {
    if (reach_m <= radius_m) return std::nullopt;
    return "has a sphere of " + all_digits_m(radius_m) + ", but what it holds reaches " +
           all_digits_m(reach_m) + " from its centre";
}

}  // namespace

std::uint32_t maker_among(std::span<const ClusterGroup> groups, std::uint32_t leaves, std::uint32_t cluster) {
    if (cluster < leaves) return no_group;
    const auto after =
        std::upper_bound(groups.begin(), groups.end(), cluster,
                         [](std::uint32_t a, const ClusterGroup& b) { return a < b.first_made; });
    return static_cast<std::uint32_t>(after - groups.begin()) - 1;
}

std::optional<std::string> wrong_level(const ClusterGroup& group, std::uint32_t member,
                                       std::span<const ClusterGroup> groups, std::uint32_t leaves) {
    const std::uint32_t maker = maker_among(groups, leaves, member);
    const std::uint32_t level = maker == no_group ? 0 : groups[maker].level;
    if (level + 1 == group.level) return std::nullopt;
    return "uses cluster " + std::to_string(member) + " of level " + std::to_string(level) +
           ", expected level " + std::to_string(group.level - 1);
}

std::optional<std::string> wrong_growth(const GroupPart& part, std::span<const ClusterGroup> groups,
                                        std::uint32_t leaves) {
    double below_m = 0.0, reach_m = 0.0;
    std::uint32_t last = no_group;
    for (const std::uint32_t member : part.members) {
        const std::uint32_t maker = maker_among(groups, leaves, member);
        if (maker == no_group || maker == last) continue;
        last = maker;
        const ClusterGroup& below = groups[maker];
        below_m = std::max(below_m, below.error_m);
        reach_m = std::max(reach_m, glm::distance(below.centre.m, part.group.centre.m) + below.radius_m);
    }
    if (below_m > part.group.error_m)
        return "has error " + all_digits_m(part.group.error_m) + ", but one below it has " +
               all_digits_m(below_m);
    return beyond_radius(reach_m, part.group.radius_m);
}

std::optional<std::string> beyond_sphere(const ClusterGroup& group, const Ecef& place) {
    return beyond_radius(glm::distance(place.m, group.centre.m), group.radius_m);
}

}  // namespace oro
