#include "apps/commands/mesh_levels.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "core/cluster_frame/cluster_cut.h"

namespace oro {
namespace {

// What is drawn of a level: what groups up to there made, and what none made coarser.
struct DrawnLevel {
    std::size_t triangles{}, clusters{}, groups{};
    double error_m{};
};

std::vector<DrawnLevel> drawn_levels(const ClusterGraph& graph) {
    std::vector<DrawnLevel> levels;
    double error_m = 0.0;
    for (std::uint32_t level = 0; level <= graph.levels.size(); ++level) {
        const std::vector<std::uint32_t> cut = cut_by_level(graph, level);
        if (level > 0) error_m = std::max(error_m, graph.levels[level - 1].largest_error_m);
        levels.push_back({triangles_of_cut(graph, cut), cut.size(),
                          level > 0 ? graph.levels[level - 1].groups : 0, error_m});
    }
    return levels;
}

}  // namespace

std::string mesh_levels_text(const MeshGraph& graph, int indent) {
    char row[160];
    std::snprintf(row, sizeof row, "%*s%6s %12s %10s %10s %12s\n", indent, "", "level", "triangles",
                  "clusters", "groups", "error up to");
    std::string text = row;
    std::size_t level = 0;
    for (const DrawnLevel& drawn : drawn_levels(graph.clusters)) {
        std::snprintf(row, sizeof row, "%*s%6zu %12s %10s %10s %10.3f m\n", indent, "", level++,
                      grouped(drawn.triangles).c_str(), grouped(drawn.clusters).c_str(),
                      grouped(drawn.groups).c_str(), drawn.error_m);
        text += row;
    }
    return text;
}

nlohmann::ordered_json mesh_levels_json(const MeshGraph& graph) {
    nlohmann::ordered_json levels = nlohmann::ordered_json::array();
    for (const DrawnLevel& drawn : drawn_levels(graph.clusters))
        levels.push_back(json_object("triangles", drawn.triangles, "clusters", drawn.clusters, "groups",
                                     drawn.groups, "largest_error_m", drawn.error_m));
    return levels;
}

}  // namespace oro
