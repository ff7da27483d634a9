// The triangles of a mesh in the true ground, in a tree of boxes that all eyes share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/result.h"
#include "core/earth/ellipsoid.h"
#include "core/earth/world_model.h"

namespace oro {

// Triangles, straight between their corners.
struct MeshTriangles {
    std::vector<glm::dvec3> vertices_m;  // ECEF, as drawn
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> features;  // of each triangle: its number, from 1; empty: none
};

class TriangleSource;
class TrueMeshParts;

class TrueMesh {
  public:
    // number: of the mesh, from 1. Takes some 50 bytes a triangle, those given among them, and 0.3 us of one
    // thread. The tree is the same by any number of threads.
    TrueMesh(MeshTriangles mesh, std::uint32_t number, int threads);
    // Of triangles that are read where a line may meet them; all of them where somebody asks for one by its
    // number. most_bytes: of memory that what was read for lines takes between lines.
    TrueMesh(std::shared_ptr<const TriangleSource> source, std::uint32_t number, int threads,
             std::uint64_t most_bytes);

    [[nodiscard]] std::uint32_t number() const { return number_; }
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] const std::vector<glm::dvec3>& vertices_m() const { return whole().mesh_.vertices_m; }
    // ECEF, metres.
    [[nodiscard]] std::array<glm::dvec3, 3> corners_m(std::size_t triangle) const {
        const MeshTriangles& all = whole().mesh_;
        const auto& [a, b, c] = all.triangles[triangle];
        return {all.vertices_m[a], all.vertices_m[b], all.vertices_m[c]};
    }
    [[nodiscard]] std::uint32_t feature(std::size_t triangle) const {
        const MeshTriangles& all = whole().mesh_;
        return all.features.empty() ? 0 : all.features[triangle];
    }
    // Errors: triangles that could not be read, and so were not there.
    [[nodiscard]] Result<void> health() const;

    struct Hit {
        double along_m{};  // the line, from its start
        std::uint32_t triangle{};
        std::uint32_t feature{};  // of that triangle, from 1; 0: none
    };
    // How far along a line (`direction` of length 1) its first triangle is, as an eye on the ellipsoid sees
    // it through that air, less than reach_m and not before its start, from either side. start_m: from the
    // eye, ECEF axes. Error: rounding of doubles, so that a line through a common side of two triangles meets
    // one of them at least.
    [[nodiscard]] std::optional<Hit> first_hit(const Ecef& eye, const Refraction& refraction,
                                               const glm::dvec3& start_m, const glm::dvec3& direction,
                                               double reach_m) const;

    // The place of its triangles that is nearest to a point, as far as that is nearer than reach_m. ECEF,
    // metres. Error: rounding of doubles.
    [[nodiscard]] std::optional<glm::dvec3> nearest_m(const glm::dvec3& at_m, double reach_m) const;

  private:
    // A box from the origin in the frame, widened by what rounding takes from a line. Nodes lie in the order
    // of a walk: the first below a node is the next one.
    struct Node {
        std::array<float, 3> low{}, high{};
        std::uint32_t first{};  // of its triangles, in order_; of others the second node below
        std::uint32_t count{};  // of its triangles; 0: it has two nodes
    };
    struct Part {  // of the triangles, and the node that holds it
        std::uint32_t node{}, first{}, last{};
    };
    [[nodiscard]] Part halve(const Part& part, const std::vector<glm::vec3>& middles, Part& other);
    void build(const Part& part, const std::vector<glm::vec3>& middles);
    void bound(const Part& part);
    void join(std::uint32_t node);
    // With all triangles.
    [[nodiscard]] const TrueMesh& whole() const;

    MeshTriangles mesh_;
    std::uint32_t number_;
    glm::dvec3 origin_m_{};             // ECEF, in the middle
    glm::dmat3 frame_from_ecef_{1.0};   // east, north, up there
    std::vector<std::uint32_t> order_;  // of triangles, as the nodes hold them
    std::vector<Node> nodes_;
    std::shared_ptr<const TrueMeshParts> parts_;  // null: all triangles are here
};

}  // namespace oro
