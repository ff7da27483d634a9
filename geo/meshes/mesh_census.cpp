#include "geo/meshes/mesh_census.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "geo/meshes/crs_unit.h"

namespace oro {
namespace {

constexpr double lattice_steps_per_m = 2048.0;

// The number of each vertex after welding: the least vertex at its lattice point.
std::vector<std::uint32_t> welded(const std::vector<glm::dvec3>& lattice) {
    std::vector<std::uint32_t> order(lattice.size()), same(lattice.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t i) { return std::array{lattice[i].x, lattice[i].y, lattice[i].z}; };
    // What is not finite belongs to no triangle.
    std::erase_if(order, [&](std::uint32_t i) {
        return !(std::isfinite(lattice[i].x) && std::isfinite(lattice[i].y) && std::isfinite(lattice[i].z));
    });
    std::ranges::sort(
        order, [&](std::uint32_t a, std::uint32_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool again = i > 0 && key(order[i]) == key(order[i - 1]);
        same[order[i]] = again ? same[order[i - 1]] : order[i];
    }
    return same;
}

// Exact where the sides are shorter than 2^31 steps (1,000 km).
bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 u = b - a, v = c - a;
    const auto differ = [](double p, double q, double r, double s) {
        return static_cast<long double>(p) * q != static_cast<long double>(r) * s;
    };
    return differ(u.x, v.y, u.y, v.x) || differ(u.y, v.z, u.z, v.y) || differ(u.z, v.x, u.x, v.z);
}

struct RimEdge {
    std::uint32_t from, to;
};

// Walks along rim edges that have not been walked, each once, until it is back or stuck.
void count_chains(const std::vector<RimEdge>& rim, MeshCensus& census) {
    std::vector<std::pair<std::uint32_t, std::size_t>> ends;  // a vertex and an edge there
    for (std::size_t i = 0; i < rim.size(); ++i) {
        ends.emplace_back(rim[i].from, i);
        ends.emplace_back(rim[i].to, i);
    }
    std::ranges::sort(ends);
    std::vector<char> walked(rim.size());
    const auto next_edge = [&](std::uint32_t vertex) {
        auto at = std::ranges::lower_bound(ends, std::pair(vertex, std::size_t{0}));
        while (at != ends.end() && at->first == vertex && walked[at->second] != 0) ++at;
        return at != ends.end() && at->first == vertex ? at->second : rim.size();
    };
    // Chains that end somewhere first, from their ends: vertices where an odd number of edges meet.
    const auto walk = [&](std::uint32_t begin) {
        std::uint32_t here = begin;
        for (std::size_t edge = next_edge(here); edge < rim.size(); edge = next_edge(here)) {
            walked[edge] = 1;
            here = rim[edge].from == here ? rim[edge].to : rim[edge].from;
            if (here == begin) break;
        }
        ++(here == begin ? census.rims : census.open_chains);
    };
    for (std::size_t i = 0, j = 0; i < ends.size(); i = j) {
        while (j < ends.size() && ends[j].first == ends[i].first) ++j;
        if ((j - i) % 2 == 1 && next_edge(ends[i].first) < rim.size()) walk(ends[i].first);
    }
    for (std::size_t i = 0; i < rim.size(); ++i)
        if (walked[i] == 0) walk(rim[i].from);
}

struct SidedEdge {
    std::uint32_t low, high;
    bool upward;  // the triangle runs from low to high
    auto operator<=>(const SidedEdge&) const = default;
};

void count_edges(const std::vector<SourceTriangle>& triangles, MeshCensus& census) {
    std::vector<SidedEdge> edges;
    edges.reserve(3 * triangles.size());
    for (const SourceTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to});
        }
    }
    std::ranges::sort(edges);
    std::vector<RimEdge> rim;
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        while (j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
        if (j - i == 1) rim.push_back({edges[i].low, edges[i].high});
        if (j - i == 2 && edges[i].upward == edges[i + 1].upward) ++census.turned_edges;
        if (j - i > 2) ++census.crowded_edges;
    }
    census.rim_edges = rim.size();
    count_chains(rim, census);
}

// Metres of a step along each axis; of degrees near the first vertex.
glm::dvec3 metres_of(const SourceMesh& mesh, const std::string& asked_crs) {
    const std::string& crs = asked_crs.empty() ? mesh.crs : asked_crs;
    if (crs.empty() || crs == ecef_crs || crs_unit_m(crs)) return glm::dvec3(mesh.metres_per_unit);
    constexpr double m_per_deg = 111320.0;
    const double lat_deg = mesh.triangles.empty() ? 0.0 : mesh.vertices[mesh.triangles.front()[0]].y;
    return {m_per_deg * std::cos(lat_deg * std::numbers::pi / 180.0), m_per_deg, mesh.metres_per_unit};
}

}  // namespace

MeshCensus census_of(const SourceMesh& mesh, const std::string& crs) {
    MeshCensus census;
    census.triangles = mesh.triangles.size();
    std::vector<glm::dvec3> lattice(mesh.vertices.size());
    const glm::dvec3 metres = metres_of(mesh, crs);
    std::ranges::transform(mesh.vertices, lattice.begin(), [&](const glm::dvec3& at) {
        return glm::round(at * (metres * lattice_steps_per_m));
    });
    const std::vector<std::uint32_t> same = welded(lattice);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    census.least = glm::dvec3(infinite), census.most = glm::dvec3(-infinite);
    std::vector<char> used(same.size());
    std::vector<std::pair<SourceTriangle, SourceTriangle>> kept;  // by its corners in order, and as it is
    for (const SourceTriangle& triangle : mesh.triangles) {
        SourceTriangle corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3& at = mesh.vertices[triangle[i]];
            census.least = glm::min(census.least, at), census.most = glm::max(census.most, at);
            corners[i] = same[triangle[i]];
            census.vertices += used[corners[i]] == 0 ? 1U : 0U;
            used[corners[i]] = 1;
        }
        if (!has_area(lattice[corners[0]], lattice[corners[1]], lattice[corners[2]])) {
            ++census.degenerate;
            continue;
        }
        SourceTriangle ordered = corners;
        std::ranges::sort(ordered);
        kept.emplace_back(ordered, corners);
    }
    std::ranges::sort(kept);
    std::vector<SourceTriangle> triangles;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (i > 0 && kept[i].first == kept[i - 1].first)
            ++census.duplicates;
        else
            triangles.push_back(kept[i].second);
    }
    count_edges(triangles, census);
    return census;
}

}  // namespace oro
