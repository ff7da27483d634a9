// A mesh of the true ground whose triangles are read part by part, where lines may meet them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/truth/true_mesh.h"

namespace oro {

// Where the triangles come from. For any number of threads at once.
class TriangleSource {
  public:
    struct Sphere {
        glm::dvec3 centre_m{};  // ECEF
        double radius_m{};
    };
    struct Part {
        MeshTriangles triangles;
        std::vector<std::uint32_t> numbers;  // that these have in the whole mesh
    };
    virtual ~TriangleSource() = default;
    // Each holds the triangles of a part. Parts beside each other lie near each other.
    [[nodiscard]] virtual std::span<const Sphere> spheres() const = 0;
    [[nodiscard]] virtual std::size_t triangles() const = 0;
    [[nodiscard]] virtual Result<Part> part(std::size_t number) const = 0;
    [[nodiscard]] virtual Result<MeshTriangles> whole() const = 0;
};

// Of parts that were read those are held that were asked for last. For any number of threads at once.
class TrueMeshParts {
  public:
    TrueMeshParts(std::shared_ptr<const TriangleSource> source, std::uint32_t number, int threads,
                  std::uint64_t most_bytes);

    [[nodiscard]] std::size_t triangles() const { return source_->triangles(); }
    // As TrueMesh::first_hit() of the whole mesh. Parts that cannot be read have no triangles: health()
    // tells.
    [[nodiscard]] std::optional<TrueMesh::Hit> first_hit(const Ecef& eye, const Refraction& refraction,
                                                         const glm::dvec3& start_m,
                                                         const glm::dvec3& direction, double reach_m) const;
    // As TrueMesh::nearest_m().
    [[nodiscard]] std::optional<glm::dvec3> nearest_m(const glm::dvec3& at_m, double reach_m) const;
    // Reads all triangles when it is first asked; where they cannot be read it has none of them.
    [[nodiscard]] const TrueMesh& whole() const;
    // Errors: the first part that could not be read.
    [[nodiscard]] Result<void> health() const;

  private:
    struct Held {
        std::size_t number;
        std::shared_ptr<const TrueMesh> mesh;
        std::vector<std::uint32_t> numbers;
    };
    using Place = std::list<std::shared_ptr<const Held>>::iterator;
    struct Node {
        glm::dvec3 low{}, high{};  // from origin_m_
        std::uint32_t second{};    // the second node below; the first is the next one; 0: it is of one part
        std::uint32_t part{};
    };
    std::uint32_t build(std::size_t first, std::size_t last);
    [[nodiscard]] std::shared_ptr<const Held> part(std::size_t number) const;
    [[nodiscard]] std::shared_ptr<const Held> held(std::size_t number) const;
    void note_fault(std::size_t number, const Error& fault) const;

    std::shared_ptr<const TriangleSource> source_;
    std::uint32_t number_;
    int threads_;
    std::uint64_t most_bytes_;
    glm::dvec3 origin_m_{};
    std::vector<Node> nodes_;
    mutable std::once_flag reads_whole_;
    mutable std::unique_ptr<const TrueMesh> whole_;
    mutable std::mutex mutex_;                             // of all that follows
    mutable std::list<std::shared_ptr<const Held>> held_;  // last asked for first
    mutable std::vector<Place> place_of_;                  // by part; the end: it is not held
    mutable std::uint64_t held_bytes_{};
    mutable std::size_t faulty_part_{};
    mutable std::optional<Error> fault_;
};

}  // namespace oro
