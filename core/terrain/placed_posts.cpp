#include "core/terrain/placed_posts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/wide.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"

namespace oro {

// Loops over numbers that are reckoned with alike have no branch and no call in them; core/CMakeLists.txt
// says what else the compiler may take for granted of this file.
std::size_t PlacedPosts::gather_drawn() {
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (drawn[i] == 0) continue;
        for (std::vector<double>* const all : {&x, &y, &z, &scaled_x, &scaled_y, &scaled_z})
            (*all)[found] = (*all)[i];
        ++found;
    }
    return found;
}

ORO_WIDE void place_row(const PlacedRow& at, const std::int32_t* steps,
                        const std::array<double, gpu::page_posts>& V,
                        const std::array<double, gpu::page_posts>& W, std::size_t row, PlacedPosts& posts) {
    double* const x = &posts.x[row * PlacedPosts::across];
    double* const y = &posts.y[row * PlacedPosts::across];
    double* const z = &posts.z[row * PlacedPosts::across];
    const double normal_m = at.normal_m, cosine = at.cosine, sine = at.sine, rho0_m = at.rho0_m,
                 z0_m = at.z0_m;
    const double polar_m = normal_m * (1.0 - wgs84_e2);
    for (std::size_t j = 0; j < PlacedPosts::across; ++j) {
        const double h_m = steps[j] * height_step_m;
        const double r = (normal_m + h_m) * cosine;
        x[j] = r - rho0_m - r * V[j];
        y[j] = r * W[j];
        z[j] = (polar_m + h_m) * sine - z0_m;
    }
}

ORO_WIDE void scale_posts(const glm::dvec3& origin_m, const glm::dvec3& radii_m, PlacedPosts& posts) {
    const auto scale = [](const std::vector<double>& from, double origin, double radius,
                          std::vector<double>& to) {
        const double* const in = from.data();
        double* const out = to.data();
        for (std::size_t i = 0; i < PlacedPosts::count; ++i) out[i] = (in[i] + origin) / radius;
    };
    scale(posts.x, origin_m.x, radii_m.x, posts.scaled_x);
    scale(posts.y, origin_m.y, radii_m.y, posts.scaled_y);
    scale(posts.z, origin_m.z, radii_m.z, posts.scaled_z);
}

namespace {

PostSphere sphere_of(const glm::vec3& centre, double square, double size) {
    const double radius = std::sqrt(square) + 1.0e-3 + 4.0e-7 * std::sqrt(size);
    return {centre, std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::infinity())};
}

// Lowest and highest of some numbers.
struct Range {
    double low;
    double high;
};

}  // namespace

PostSphere sphere_around(std::span<const glm::dvec3> points) {
    glm::dvec3 low = points[0];
    glm::dvec3 high = points[0];
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const glm::vec3 centre(0.5 * (low + high));
    double square = 0.0;
    double size = 0.0;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 offset = point - glm::dvec3(centre);
        square = std::max(square, glm::dot(offset, offset));
        size = std::max(size, glm::dot(point, point));
    }
    return sphere_of(centre, square, size);
}

ORO_WIDE Range range_of(const double* numbers, std::size_t count) {
    FourDoubles low{numbers[0], numbers[0], numbers[0], numbers[0]}, high = low;
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        const FourDoubles four{numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]};
        low = four < low ? four : low;
        high = four > high ? four : high;
    }
    Range range{std::min({low[0], low[1], low[2], low[3]}), std::max({high[0], high[1], high[2], high[3]})};
    for (; i < count; ++i) range = {std::min(range.low, numbers[i]), std::max(range.high, numbers[i])};
    return range;
}

// The largest square of a distance from a place.
ORO_WIDE double largest_square(const PlacedPosts& posts, std::size_t count, const glm::dvec3& from) {
    const double *const x = posts.x.data(), *const y = posts.y.data(), *const z = posts.z.data();
    const double from_x = from.x, from_y = from.y, from_z = from.z;
    std::array<double, 16> largest{};
    const auto square = [&](std::size_t i) {
        const double a = x[i] - from_x, b = y[i] - from_y, c = z[i] - from_z;
        return a * a + b * b + c * c;
    };
    std::size_t i = 0;
    for (; i + largest.size() <= count; i += largest.size())
        for (std::size_t k = 0; k < largest.size(); ++k) {
            const double one = square(i + k);
            largest[k] = one > largest[k] ? one : largest[k];
        }
    for (; i < count; ++i) largest[0] = std::max(largest[0], square(i));
    return *std::max_element(largest.begin(), largest.end());
}

PostSphere sphere_around(const PlacedPosts& posts, std::size_t count) {
    const Range x = range_of(posts.x.data(), count), y = range_of(posts.y.data(), count),
                z = range_of(posts.z.data(), count);
    const glm::vec3 centre(0.5 * (glm::dvec3(x.low, y.low, z.low) + glm::dvec3(x.high, y.high, z.high)));
    return sphere_of(centre, largest_square(posts, count, glm::dvec3(centre)),
                     largest_square(posts, count, glm::dvec3(0.0)));
}

namespace {

constexpr std::size_t across = PlacedPosts::across;
constexpr std::size_t side = gpu::meshlets_per_side, node_quads = gpu::meshlet_quads,
                      node_posts = gpu::meshlet_posts;
using Columns = std::array<double, across>;

}  // namespace

// Of each column over the nine rows of a row of meshlets.
ORO_WIDE void column_ranges(const double* numbers, Columns& low, Columns& high) {
    for (std::size_t c = 0; c < across; ++c) low[c] = high[c] = numbers[c];
    for (std::size_t r = 1; r < node_posts; ++r) {
        const double* const row = numbers + r * across;
        for (std::size_t c = 0; c < across; ++c) {
            low[c] = row[c] < low[c] ? row[c] : low[c];
            high[c] = row[c] > high[c] ? row[c] : high[c];
        }
    }
}

// The largest squares of distances of a column's nine posts from where the column's meshlet has its centre.
ORO_WIDE void column_squares(const double* x, const double* y, const double* z, std::size_t columns,
                             const Columns& from_x, const Columns& from_y, const Columns& from_z,
                             Columns& largest) {
    for (std::size_t c = 0; c < columns; ++c) largest[c] = 0.0;
    for (std::size_t r = 0; r < node_posts; ++r) {
        const std::size_t first = r * across;
        for (std::size_t c = 0; c < columns; ++c) {
            const double a = x[first + c] - from_x[c], b = y[first + c] - from_y[c],
                         d = z[first + c] - from_z[c];
            const double one = a * a + b * b + d * d;
            largest[c] = one > largest[c] ? one : largest[c];
        }
    }
}

namespace {

double largest_of_node(const Columns& columns, std::size_t node, std::size_t count) {
    const auto first = columns.begin() + static_cast<std::ptrdiff_t>(node * node_quads);
    return *std::max_element(first, first + static_cast<std::ptrdiff_t>(count));
}

// Of a row of meshlets, where x, y and z are those of its first row of posts.
class MeshletRow {
  public:
    MeshletRow(const double* x, const double* y, const double* z) : at_{x, y, z} {
        for (std::size_t axis = 0; axis < 3; ++axis) find_centres(axis);
        column_squares(x, y, z, across, nowhere_, nowhere_, nowhere_, sizes_);
        column_squares(x, y, z, across - 1, from_[0], from_[1], from_[2], squares_);
    }
    [[nodiscard]] PostSphere sphere(std::size_t node) const {
        const std::size_t first = node * node_quads;
        const glm::dvec3 centre(from_[0][first], from_[1][first], from_[2][first]);
        double square = largest_of_node(squares_, node, node_quads);
        // The last column is the next meshlet's first.
        for (std::size_t r = 0; r < node_posts; ++r) {
            const std::size_t i = r * across + first + node_quads;
            const glm::dvec3 offset = glm::dvec3(at_[0][i], at_[1][i], at_[2][i]) - centre;
            square = std::max(square, glm::dot(offset, offset));
        }
        return sphere_of(glm::vec3(centre), square, largest_of_node(sizes_, node, node_posts));
    }

  private:
    void find_centres(std::size_t axis) {
        Columns low, high;
        column_ranges(at_[axis], low, high);
        for (std::size_t node = 0; node < side; ++node) {
            const std::size_t first = node * node_quads;
            const double lowest = *std::min_element(&low[first], &low[first] + node_posts);
            const double highest = *std::max_element(&high[first], &high[first] + node_posts);
            const auto centre = static_cast<double>(static_cast<float>(0.5 * (lowest + highest)));
            std::fill_n(&from_[axis][first], node_quads, centre);
        }
    }

    std::array<const double*, 3> at_;
    std::array<Columns, 3> from_{};
    Columns nowhere_{}, squares_, sizes_;
};

}  // namespace

void spheres_of_meshlets(const PlacedPosts& posts, std::array<PostSphere, gpu::meshlets_per_page>& spheres) {
    for (std::size_t row = 0; row < side; ++row) {
        const std::size_t first = row * node_quads * across;
        const MeshletRow meshlets(&posts.x[first], &posts.y[first], &posts.z[first]);
        for (std::size_t node = 0; node < side; ++node) spheres[row * side + node] = meshlets.sphere(node);
    }
}

namespace {

constexpr std::size_t cone_points = 128;  // at a time
struct ConeAngles {
    std::array<double, cone_points> sine;
    std::array<double, cone_points> cosine;
};

}  // namespace

// Of some points' angles in horizon_cone(), by the same steps as there and in horizon_point().
ORO_WIDE void cone_angles(const double* x, const double* y, const double* z, std::size_t count,
                          const glm::dvec3& direction, ConeAngles& angles) {
    const double dx = direction.x, dy = direction.y, dz = direction.z;
    for (std::size_t i = 0; i < count; ++i) {
        const double r = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
        const double beyond = (r - 1.0) * (r + 1.0);
        const double tangent = std::sqrt(beyond > 0.0 ? beyond : 0.0);
        const double scale = 1.0 / (r * (1.0 < r ? r : 1.0));
        const double along = x[i] * dx + y[i] * dy + z[i] * dz;
        const double a = y[i] * dz - dy * z[i], b = z[i] * dx - dz * x[i], c = x[i] * dy - dx * y[i];
        const double across_point = std::sqrt(a * a + b * b + c * c);
        angles.sine[i] = (tangent * along + across_point) * scale;
        angles.cosine[i] = (along - tangent * across_point) * scale;
    }
}

namespace {

HorizonCone cone_of_each(const PlacedPosts& posts, std::size_t count) {
    std::vector<HorizonPoint> points;
    points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) points.push_back(horizon_point(posts.scaled(i)));
    return horizon_cone(points);
}

}  // namespace

HorizonCone horizon_cone(const PlacedPosts& posts, std::size_t count) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < count; ++i) sum += posts.scaled(i);
    const double length = glm::length(sum);
    if (!(length > 1.0e-9 * static_cast<double>(count))) return cone_of_each(posts, count);
    HorizonCone cone;
    cone.direction = sum / length;
    double largest_sine = 0.0;
    double its_cosine = 1.0;
    double smallest_cosine = 1.0;
    ConeAngles angles;
    for (std::size_t first = 0; first < count; first += cone_points) {
        const std::size_t some = std::min(cone_points, count - first);
        cone_angles(&posts.scaled_x[first], &posts.scaled_y[first], &posts.scaled_z[first], some,
                    cone.direction, angles);
        smallest_cosine = std::min(smallest_cosine, range_of(angles.cosine.data(), some).low);
        const double largest = range_of(angles.sine.data(), some).high;
        if (!(largest > largest_sine)) continue;
        largest_sine = largest;
        const auto at = std::find(angles.sine.begin(), angles.sine.end(), largest);
        its_cosine = angles.cosine[static_cast<std::size_t>(at - angles.sine.begin())];
    }
    // A region as wide as a continent.
    if (!(smallest_cosine > 0.0)) return cone_of_each(posts, count);
    cone.angle_rad = std::atan2(largest_sine, its_cosine);
    return cone;
}

}  // namespace oro
