// Some vertices of a surface, numbered anew: for meshes that use few of them.
#pragma once

#include <vector>

#include "core/surface/original_surface.h"

namespace oro {

// A part of a surface's vertices, with that surface to be measured against. Numbers keep their order, so what
// is built over it is what would be built over the surface itself. It has no triangles of its own.
class VertexSubset final : public OriginalSurface {
  public:
    // vertices: of `whole`, rising. Both are kept where they are.
    VertexSubset(const OriginalSurface& whole, const std::vector<VertexNumber>& vertices)
        : whole_(whole), vertices_(vertices) {}

    [[nodiscard]] std::size_t vertex_count() const override { return vertices_.size(); }
    [[nodiscard]] SurfaceVertex vertex(VertexNumber number) const override {
        return whole_.vertex(vertices_[number]);
    }
    [[nodiscard]] bool is_open(VertexNumber number) const override {
        return whole_.is_open(vertices_[number]);
    }
    [[nodiscard]] bool is_window() const override { return whole_.is_window(); }
    [[nodiscard]] bool must_stay(VertexNumber number) const override {
        return whole_.must_stay(vertices_[number]);
    }
    [[nodiscard]] std::vector<std::vector<VertexTriangle>> leaves() const override { return {}; }
    [[nodiscard]] double edge_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                         double limit) const override {
        return whole_.edge_difference(from, to, limit);
    }
    [[nodiscard]] double inner_difference(const SurfaceVertex& a, const SurfaceVertex& b,
                                          const SurfaceVertex& c, double limit) const override {
        return whole_.inner_difference(a, b, c, limit);
    }

  private:
    const OriginalSurface& whole_;
    const std::vector<VertexNumber>& vertices_;
};

}  // namespace oro
