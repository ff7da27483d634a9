#include "geo/tilesets/level_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geo/tilesets/clipped_triangle.h"

namespace oro {
namespace {

// A cluster is drawn when what made it is good enough and what uses it is not (docs/CLUSTERS.md).
bool in_cut(const ClusterGraph& graph, const Cluster& cluster, double error_m) {
    const bool made = cluster.made_by == no_group || graph.groups[cluster.made_by].error_m <= error_m;
    const bool used = cluster.used_by != no_group && graph.groups[cluster.used_by].error_m <= error_m;
    return made && !used;
}

float rounded_up(double value) {
    const auto near = static_cast<float>(value);
    return static_cast<double>(near) >= value ? near
                                              : std::nextafter(near, std::numeric_limits<float>::infinity());
}

std::array<SurfaceVertex, 3> corners_of(const OriginalSurface& surface, const VertexTriangle& triangle) {
    return {surface.vertex(triangle[0]), surface.vertex(triangle[1]), surface.vertex(triangle[2])};
}

// Gives a triangle to the tiles that it reaches into.
void share_out(const ClusteredGround& ground, const TilesetLayout& layout, int level, LevelCut& cut) {
    cut.tiles.resize(layout.count(level));
    TriangleClip clip;
    for (std::uint32_t i = 0; i < cut.triangles.size(); ++i) {
        const auto corners = corners_of(ground.surface(), cut.triangles[i]);
        const auto [north, south] = std::minmax({corners[0].row, corners[1].row, corners[2].row});
        const auto [west, east] = std::minmax({corners[0].column, corners[1].column, corners[2].column});
        const int first_row = layout.tile_of(north, level), last_row = layout.tile_of(south - 1, level),
                  first_column = layout.tile_of(west, level), last_column = layout.tile_of(east - 1, level);
        const bool alone = first_row == last_row && first_column == last_column;
        for (int row = first_row; row <= last_row; ++row) {
            for (int column = first_column; column <= last_column; ++column) {
                const TileIndex tile{row, column, level};
                if (alone || clip.clip(corners, cut.triangles[i], layout.lines(tile)).size() >= 3)
                    cut.tiles[layout.number(tile)].push_back(i);
            }
        }
    }
}

}  // namespace

LevelCut level_cut(const ClusteredGround& ground, const TilesetLayout& layout, int level, double error_m,
                   double step_m) {
    const ClusterGraph& graph = ground.graph();
    LevelCut cut;
    cut.step_m = step_m;
    for (const Cluster& cluster : graph.clusters) {
        if (!in_cut(graph, cluster, error_m)) continue;
        const auto triangles = graph.triangles_of(cluster);
        cut.triangles.insert(cut.triangles.end(), triangles.begin(), triangles.end());
        const float of_cluster =
            cluster.made_by == no_group ? 0.0F : rounded_up(graph.groups[cluster.made_by].error_m);
        cut.errors_m.insert(cut.errors_m.end(), triangles.size(), of_cluster);
    }
    share_out(ground, layout, level, cut);
    return cut;
}

std::vector<glm::vec3> normals_of(const ClusteredGround& ground, const LevelCut& cut) {
    std::vector<glm::vec3> normals(ground.surface().vertex_count(), glm::vec3(0.0F));
    for (const VertexTriangle& triangle : cut.triangles) {
        const auto corners = corners_of(ground.surface(), triangle);
        const glm::dvec3 first_m = ground.ecef(corners[0]).m;
        // Corners run clockwise.
        const glm::dvec3 normal =
            glm::cross(ground.ecef(corners[2]).m - first_m, ground.ecef(corners[1]).m - first_m);
        for (const VertexNumber number : triangle) normals[number] += glm::vec3(normal);
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        if (length > 0.0F) normal /= length;
    }
    return normals;
}

}  // namespace oro
