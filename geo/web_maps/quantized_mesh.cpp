#include "geo/web_maps/quantized_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

static_assert(std::endian::native == std::endian::little, "quantized-mesh is little endian");

constexpr int corners = quantized_quads + 1;
constexpr std::uint32_t no_vertex = 0xFFFFFFFFU;

class Bytes {
  public:
    template <class Value>
    void add(const Value& value) {
        std::array<std::uint8_t, sizeof(Value)> raw;
        std::memcpy(raw.data(), &value, sizeof(Value));
        bytes_.insert(bytes_.end(), raw.begin(), raw.end());
    }
    void add(const glm::dvec3& point) {
        for (const double part : {point.x, point.y, point.z}) add(part);
    }
    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
};

std::size_t corner_number(int row, int column) {
    return static_cast<std::size_t>(row * corners + column);
}

// Triangles, anticlockwise from above, with vertices numbered by their first use.
struct NumberedGrid {
    std::vector<std::uint32_t> number_of_corner = std::vector<std::uint32_t>(corners * corners, no_vertex);
    std::vector<std::array<int, 2>> corner_of_number;  // row and column
    std::vector<std::uint32_t> indices;
};

NumberedGrid numbered_grid() {
    NumberedGrid grid;
    const auto use = [&](int row, int column) {
        std::uint32_t& number = grid.number_of_corner[corner_number(row, column)];
        if (number == no_vertex) {
            number = static_cast<std::uint32_t>(grid.corner_of_number.size());
            grid.corner_of_number.push_back({row, column});
        }
        grid.indices.push_back(number);
    };
    for (int row = 0; row < quantized_quads; ++row) {
        for (int column = 0; column < quantized_quads; ++column) {
            use(row, column), use(row, column + 1), use(row + 1, column + 1);
            use(row, column), use(row + 1, column + 1), use(row + 1, column);
        }
    }
    return grid;
}

const NumberedGrid& the_grid() {
    static const NumberedGrid grid = numbered_grid();
    return grid;
}

void add_differences(Bytes& bytes, const std::vector<int>& values) {
    int before = 0;
    for (const int value : values) {
        const int difference = value - before;
        bytes.add(static_cast<std::uint16_t>(difference >= 0 ? 2 * difference : -2 * difference - 1));
        before = value;
    }
}

void add_edge(Bytes& bytes, bool along_row, int fixed) {
    bytes.add(static_cast<std::uint32_t>(corners));
    for (int i = 0; i < corners; ++i)
        bytes.add(static_cast<std::uint16_t>(
            the_grid().number_of_corner[along_row ? corner_number(fixed, i) : corner_number(i, fixed)]));
}

// Where the tile's corners lie, as their numbers have them.
std::vector<glm::dvec3> points_of(const GeographicTile& tile, const TileHeights& heights_m,
                                  const HeightSteps& steps) {
    const PostPlace south_west = south_west_of(tile);
    const double side_deg = geographic_tile_deg(tile.zoom);
    std::vector<glm::dvec3> points;
    points.reserve(heights_m.size());
    for (int row = 0; row < corners; ++row) {
        for (int column = 0; column < corners; ++column) {
            const double h_m =
                height_of_quantized_m(quantized_height(heights_m[corner_number(row, column)], steps), steps);
            points.push_back(
                ecef_from_geodetic(
                    {south_west.lat_deg + side_deg * quantized_corner(row) / quantized_steps,
                     south_west.lon_deg + side_deg * quantized_corner(column) / quantized_steps, h_m})
                    .m);
        }
    }
    return points;
}

void add_header(Bytes& bytes, const GeographicTile& tile, const TileHeights& heights_m,
                const HeightSteps& steps) {
    const std::vector<glm::dvec3> points = points_of(tile, heights_m, steps);
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& point : points) low = glm::min(low, point), high = glm::max(high, point);
    const glm::dvec3 centre = 0.5 * (low + high);
    double radius_m = 0.0;
    for (const glm::dvec3& point : points) radius_m = std::max(radius_m, glm::distance(point, centre));
    bytes.add(centre);
    bytes.add(steps.lowest_h_m);
    bytes.add(steps.highest_h_m);
    bytes.add(centre);
    bytes.add(radius_m);
    bytes.add(horizon_occlusion_point(points, centre));
}

}  // namespace

HeightSteps height_steps_of(const TileHeights& heights_m) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const auto [lowest, highest] = std::ranges::minmax_element(heights_m);
    HeightSteps steps{static_cast<float>(*lowest), static_cast<float>(*highest)};
    if (static_cast<double>(steps.lowest_h_m) > *lowest)
        steps.lowest_h_m = std::nextafter(steps.lowest_h_m, -infinite);
    if (static_cast<double>(steps.highest_h_m) < *highest)
        steps.highest_h_m = std::nextafter(steps.highest_h_m, infinite);
    return steps;
}

std::uint16_t quantized_height(double h_m, const HeightSteps& steps) {
    const double lowest = steps.lowest_h_m, range = static_cast<double>(steps.highest_h_m) - lowest;
    if (range <= 0.0) return 0;
    return static_cast<std::uint16_t>(
        std::clamp(std::round((h_m - lowest) / range * quantized_steps), 0.0, double{quantized_steps}));
}

double height_of_quantized_m(std::uint16_t quantized, const HeightSteps& steps) {
    const double lowest = steps.lowest_h_m;
    return lowest + (static_cast<double>(steps.highest_h_m) - lowest) * quantized / quantized_steps;
}

int quantized_corner(int corner) {
    return static_cast<int>(std::lround(static_cast<double>(corner) * quantized_steps / quantized_quads));
}

std::vector<std::uint8_t> quantized_mesh_bytes(const GeographicTile& tile, const TileHeights& heights_m) {
    const HeightSteps steps = height_steps_of(heights_m);
    const NumberedGrid& grid = the_grid();
    Bytes bytes;
    add_header(bytes, tile, heights_m, steps);
    bytes.add(static_cast<std::uint32_t>(grid.corner_of_number.size()));
    std::array<std::vector<int>, 3> values;  // along the parallel, along the meridian, heights
    for (const auto& [row, column] : grid.corner_of_number) {
        values[0].push_back(quantized_corner(column));
        values[1].push_back(quantized_corner(row));
        values[2].push_back(quantized_height(heights_m[corner_number(row, column)], steps));
    }
    for (const std::vector<int>& one : values) add_differences(bytes, one);
    bytes.add(static_cast<std::uint32_t>(grid.indices.size() / 3));
    std::uint32_t highest = 0;  // the next number that is used for the first time
    for (const std::uint32_t index : grid.indices) {
        bytes.add(static_cast<std::uint16_t>(highest - index));
        if (index == highest) ++highest;
    }
    add_edge(bytes, false, 0);                // west
    add_edge(bytes, true, 0);                 // south
    add_edge(bytes, false, quantized_quads);  // east
    add_edge(bytes, true, quantized_quads);   // north
    return bytes.take();
}

glm::dvec3 horizon_occlusion_point(const std::vector<glm::dvec3>& points_m, const glm::dvec3& towards_m) {
    constexpr double far = 1000.0;  // radii: as good as everywhere
    const glm::dvec3 radii_m(wgs84_a_m, wgs84_a_m, wgs84_b_m);
    const glm::dvec3 towards = glm::normalize(towards_m / radii_m);
    double farthest = 1.0;
    for (const glm::dvec3& point_m : points_m) {
        const glm::dvec3 point = point_m / radii_m;
        const double length = glm::length(point), above = std::max(1.0, length);
        const double cosine = glm::dot(point, towards) / length;
        const double sine = glm::length(glm::cross(point, towards)) / length;
        // Of the angle from the point to where its own horizon is.
        const double horizon_cosine = 1.0 / above,
                     horizon_sine = std::sqrt(1.0 - horizon_cosine * horizon_cosine);
        const double along = cosine * horizon_cosine - sine * horizon_sine;
        if (along <= 1.0 / far) return far * towards;
        farthest = std::max(farthest, 1.0 / along);
    }
    return farthest * towards;
}

}  // namespace oro
