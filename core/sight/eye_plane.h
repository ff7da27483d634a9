// The ground around an eye, as it is seen: posts over the plane that is level there. Within core.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <limits>
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

// Has the processor fetch what lies there before it is asked for.
inline void fetch_ahead([[maybe_unused]] const void* place) {
#if defined(__GNUC__)
    __builtin_prefetch(place);
#endif
}

// The posts of a window and a rim of one post around it, which has no place (NaN). A void post has a place,
// and NaN for a height. Numbers count through rows of the rimmed window.
class EyePlane {
  public:
    EyePlane(const TrueSurface& surface, const Observer& observer, const GridPart& window, int threads);

    [[nodiscard]] const PlanePost& post(std::int64_t number) const {
        return posts_[static_cast<std::size_t>(number)];
    }
    // Has the processor fetch what it will be asked of a post.
    void fetch(std::int64_t number) const {
        fetch_ahead(&posts_[static_cast<std::size_t>(number)]);
        if (!most_tangents_.empty()) fetch_ahead(&most_tangents_[static_cast<std::size_t>(number)]);
    }
    [[nodiscard]] std::int64_t number(int row, int column) const { return (row + 1) * stride_ + column + 1; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }
    // The neighbours of a post, turning one way; each two that follow each other, and it, are a triangle.
    struct Neighbours {
        std::array<std::int64_t, 8> numbers;
        int count;  // 4 to 8
    };
    [[nodiscard]] Neighbours neighbours(std::int64_t number) const {
        const auto sw_ne = [&](std::int64_t cell) { return sw_ne_[static_cast<std::size_t>(cell)] != 0; };
        Neighbours around{{}, 0};
        const auto add = [&](std::int64_t step) {
            around.numbers[static_cast<std::size_t>(around.count++)] = number + step;
        };
        add(1);
        if (!sw_ne(number)) add(stride_ + 1);
        add(stride_);
        if (sw_ne(number - 1)) add(stride_ - 1);
        add(-1);
        if (!sw_ne(number - stride_ - 1)) add(-stride_ - 1);
        add(-stride_);
        if (sw_ne(number - stride_)) add(1 - stride_);
        return around;
    }
    // The third post of the triangle on the other side of the edge of two, seen from the third on this side.
    [[nodiscard]] std::int64_t beyond(std::int64_t one, std::int64_t other, std::int64_t before) const {
        const std::int64_t low = std::min(one, other), high = std::max(one, other);
        const auto sw_ne = [&](std::int64_t cell) { return sw_ne_[static_cast<std::size_t>(cell)] != 0; };
        if (high - low == 1) {  // along a row
            const bool south = before < low;
            if (south) return sw_ne(low) ? low + stride_ : high + stride_;
            return sw_ne(low - stride_) ? high - stride_ : low - stride_;
        }
        if (high - low == stride_) {  // along a column
            const bool east = before == low - 1 || before == high - 1;
            if (east) return sw_ne(low) ? low + 1 : high + 1;
            return sw_ne(low - 1) ? high - 1 : low - 1;
        }
        return one + other - before;  // a diagonal: across the cell
    }

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

    // Makes ready what bounds how high the edges around a post are seen, so far across the plane: the tangent
    // of the highest post around one, infinite where posts around have no place or no height or stand too
    // close together, and what makes a bound of that (SweptPosts).
    void bound_tangents(double around_m, int threads);
    struct TangentBound {
        double around_m, longest_edge_m, error_m;
    };
    [[nodiscard]] TangentBound tangent_bound() const { return {around_m_, longest_edge_m_, error_m_}; }
    [[nodiscard]] double most_tangent_of_box(std::int64_t number) const {
        return most_tangents_.empty() ? std::numeric_limits<double>::infinity()
                                      : static_cast<double>(most_tangents_[static_cast<std::size_t>(number)]);
    }

    // The normal of the ellipsoid at a post of the window, in the plane's axes.
    [[nodiscard]] glm::dvec3 normal(int row, int column) const;
    // What the bend of light adds to a height as it is seen: so much times the square of the distance, 1/m.
    [[nodiscard]] double bend_per_m() const { return bend_per_m_; }

  private:
    void place_row(const TrueSurface& surface, int row);
    void measure(const PostGrid& grid, int threads);
    void set_error(double up_m, double sideways_m, double steepest2);

    GridPart window_;
    std::int64_t stride_;
    std::size_t count_;  // of all posts, the rim's among them
    std::unique_ptr<PlanePost[]> posts_;
    std::vector<char> sw_ne_;  // of the cell south-east of each; those that the window has not wholly: nw_se
    glm::dmat3 enu_from_ecef_;
    glm::dvec3 eye_enu_{};                            // of the eye's ECEF place
    std::shared_ptr<const LatticeGeoreference> net_;  // where posts lie on one, instead of rows_ and columns_
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
