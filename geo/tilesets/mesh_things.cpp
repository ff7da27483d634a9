#include "geo/tilesets/mesh_things.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "core/earth/ellipsoid.h"
#include "geo/tilesets/space_box.h"

namespace oro {
namespace {

SpaceBox box_of(const PlacedMesh& mesh, std::span<const glm::dvec3> vertices_m,
                std::span<const std::uint32_t> triangles) {
    SpaceBox box;
    for (const std::uint32_t triangle : triangles)
        for (const std::uint32_t corner : mesh.triangles[triangle]) box.add(vertices_m[corner]);
    return box;
}

class ThingCutter {
  public:
    ThingCutter(const PlacedMesh& mesh, std::span<const glm::dvec3> vertices_m, std::size_t most_triangles,
                double widest_m)
        : mesh_(mesh), vertices_m_(vertices_m), most_triangles_(most_triangles), widest_m_(widest_m) {}

    // Appends the thing, or its pieces.
    void add(MeshThing thing, std::vector<MeshThing>& things) const {
        const SpaceBox box = box_of(mesh_, vertices_m_, thing.triangles);
        const glm::dvec3 sides_m = box.high_m - box.low_m;
        const double widest_m = box.widest_m();
        thing.middle_m = box.middle_m();
        if (thing.triangles.size() == 1 ||
            (thing.triangles.size() <= most_triangles_ && widest_m <= widest_m_)) {
            things.push_back(std::move(thing));
            return;
        }
        const int axis = sides_m.x >= widest_m ? 0 : sides_m.y >= widest_m ? 1 : 2;
        std::ranges::stable_sort(thing.triangles, {},
                                 [&](std::uint32_t triangle) { return sum_along(triangle, axis); });
        MeshThing other = thing;
        const auto half = static_cast<std::ptrdiff_t>(thing.triangles.size() / 2);
        other.triangles.assign(thing.triangles.begin() + half, thing.triangles.end());
        thing.triangles.resize(static_cast<std::size_t>(half));
        add(std::move(thing), things);
        add(std::move(other), things);
    }

  private:
    [[nodiscard]] double sum_along(std::uint32_t triangle, int axis) const {
        double sum_m = 0.0;
        for (const std::uint32_t corner : mesh_.triangles[triangle]) sum_m += vertices_m_[corner][axis];
        return sum_m;
    }

    const PlacedMesh& mesh_;
    std::span<const glm::dvec3> vertices_m_;
    std::size_t most_triangles_;
    double widest_m_;
};

// Of each triangle a number that those of its thing have alone: of triangles that hang together by vertices.
std::vector<std::uint32_t> joined_by_vertices(const PlacedMesh& mesh) {
    std::vector<std::uint32_t> of(mesh.vertices.size());
    std::iota(of.begin(), of.end(), 0U);
    const auto first_of = [&](std::uint32_t vertex) {
        while (of[vertex] != vertex) vertex = of[vertex] = of[of[vertex]];
        return vertex;
    };
    for (const SourceTriangle& triangle : mesh.triangles)
        for (std::size_t i = 1; i < 3; ++i) {
            const std::uint32_t a = first_of(triangle[0]), b = first_of(triangle[i]);
            of[std::max(a, b)] = std::min(a, b);
        }
    std::vector<std::uint32_t> numbers;
    numbers.reserve(mesh.triangles.size());
    for (const SourceTriangle& triangle : mesh.triangles) numbers.push_back(first_of(triangle[0]));
    return numbers;
}

}  // namespace

std::vector<glm::dvec3> vertices_of_mesh(const PlacedMesh& mesh, const UndulationField& undulation) {
    std::vector<glm::dvec3> vertices_m;
    vertices_m.reserve(mesh.vertices.size());
    for (const PlacedVertex& vertex : mesh.vertices)
        vertices_m.push_back(ecef_from_geodetic(geodetic_of(vertex, undulation, 1.0)).m);
    return vertices_m;
}

std::vector<MeshThing> things_of_mesh(const PlacedMesh& mesh, std::size_t number,
                                      std::span<const glm::dvec3> vertices_m) {
    const bool has_features = !mesh.feature_of.empty();
    const std::vector<std::uint32_t> of =
        has_features ? std::vector<std::uint32_t>(mesh.feature_of.begin(), mesh.feature_of.end())
                     : joined_by_vertices(mesh);
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> place(has_features ? mesh.features.size() : mesh.vertices.size(), none);
    std::vector<MeshThing> things;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        std::size_t& at = place[of[i]];
        if (at == none) {
            at = things.size();
            things.push_back({number, has_features ? std::optional(of[i]) : std::nullopt, {}});
        }
        things[at].triangles.push_back(static_cast<std::uint32_t>(i));
    }
    for (MeshThing& thing : things) {
        const SpaceBox box = box_of(mesh, vertices_m, thing.triangles);
        thing.size_m = box.diagonal_m();
        thing.middle_m = box.middle_m();
    }
    return things;
}

std::vector<MeshThing> pieces_of_thing(const PlacedMesh& mesh, std::span<const glm::dvec3> vertices_m,
                                       MeshThing thing, std::size_t most_triangles, double widest_m) {
    std::vector<MeshThing> pieces;
    ThingCutter(mesh, vertices_m, most_triangles, widest_m).add(std::move(thing), pieces);
    return pieces;
}

}  // namespace oro
