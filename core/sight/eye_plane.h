// The ground around an eye, as it is seen: posts over the plane that is level there. Within core.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <memory>
#include <vector>

#include "core/sight/viewshed.h"

namespace oro {

// East, north, and up as it is seen (lifted by refraction), metres from the eye.
struct PlanePost {
    double x, y, z;
    double distance_m;  // across the plane
    double tangent;     // of how high over level it is seen: z / distance_m
};
// Above 0: `b` lies to the left of `a`, seen from the eye.
inline double turn(const PlanePost& a, const PlanePost& b) {
    return a.x * b.y - a.y * b.x;
}
inline double along(const PlanePost& a, const PlanePost& b) {
    return a.x * b.x + a.y * b.y;
}

// The posts of a window and a rim of one post around it, which has no place (NaN). A void post has a place,
// and NaN for a height. Numbers count through rows of the rimmed window.
class EyePlane {
  public:
    EyePlane(const TrueSurface& surface, const Lookout& lookout, const PostWindow& window, int threads);

    [[nodiscard]] const PlanePost& post(std::int64_t number) const {
        return posts_[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] std::int64_t number(int row, int column) const { return (row + 1) * stride_ + column + 1; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }
    // The neighbours of a post, turning one way; each two that follow each other, and it, are a triangle.
    [[nodiscard]] const std::int64_t* neighbours() const { return neighbours_; }

    // No edge is longer, in the plane.
    [[nodiscard]] double longest_edge_m() const { return longest_edge_m_; }
    // How much higher the ground of an edge is than the straight line between its posts, at a share of its
    // way: it is as curved as the ellipsoid, and what is seen of it as light.
    [[nodiscard]] double bulge_m(const PlanePost& one, const PlanePost& other, double share) const {
        const double x = one.x - other.x, y = one.y - other.y;
        return share * (1.0 - share) * (x * x + y * y) * bulge_per_m_;
    }
    // With that, the net of edges is nowhere farther from the ground, in height as it is seen.
    [[nodiscard]] double error_m() const { return error_m_; }

    // Makes most_tangent_around() ready, for so far across the plane.
    void bound_tangents(double around_m, int threads);
    // No edge between two posts within that distance of a post is seen higher than at this tangent; infinite
    // where posts around have no place or no height, stand too close together, or are too near.
    [[nodiscard]] double most_tangent_around(std::int64_t number) const;

    // The normal of the ellipsoid at a post of the window, in the plane's axes.
    [[nodiscard]] glm::dvec3 normal(int row, int column) const;
    // Height of a post above the ellipsoid, as the surface has it.
    [[nodiscard]] double bend_per_m() const { return bend_per_m_; }

  private:
    void place_row(const TrueSurface& surface, int row);
    void measure(const PostGrid& grid, int threads);
    void set_error(double up_m, double sideways_m, double steepest2);

    PostWindow window_;
    std::int64_t stride_;
    std::int64_t neighbours_[6];
    std::vector<PlanePost> posts_;
    glm::dmat3 enu_from_ecef_;
    glm::dvec3 eye_enu_{};                // of the eye's ECEF place
    std::shared_ptr<const GridNet> net_;  // where posts lie on one, instead of rows_ and columns_
    double bend_per_m_;
    double bulge_per_m_;
    struct RowTerms {
        double normal_m, cosine, sine;
    };
    std::vector<RowTerms> rows_;
    std::vector<glm::dvec3> columns_;  // enu_from_ecef * (cos lon, sin lon, 0)
    double longest_edge_m_{};
    double shortest_right_m_{}, shortest_down_m_{};
    double error_m_{};
    double around_m_{};
    std::vector<float> most_tangents_;  // of the posts around each; empty where there is no bound
};

}  // namespace oro
