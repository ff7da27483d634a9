#include "core/lod/page_sums.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/lod/levels_gpu.h"

namespace oro {

float rounded_up(double value) {
    const float nearest = static_cast<float>(value);
    return static_cast<double>(nearest) < value
               ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
               : nearest;
}

namespace {

constexpr int page_side = static_cast<int>(gpu::meshlets_per_side);

void sum_up_page(PyramidPage& page) {
    PageSummary& summary = page.summary;
    double radius_m = 0.0;
    double largest_m = 0.0;
    for (const gpu::MeshletBounds& node : page.nodes) {
        largest_m = std::max(largest_m, static_cast<double>(node.error_m));
        if (node.radius < 0.0F) continue;
        radius_m = std::max(radius_m, glm::distance(summary.centre_m, glm::dvec3(node.centre)) +
                                          static_cast<double>(node.lod_radius));
    }
    summary.largest_error_m = std::min(rounded_up(error_growth * largest_m), gpu::unfit_error_m);
    summary.lod_radius_m = radius_growth * radius_m;
}

void sum_up_quarter(PyramidPage& page, int number) {
    PageQuarter& quarter = page.quarters[static_cast<std::size_t>(number)];
    const int first_row = number / 2 * (page_side / 2);
    const int first_column = number % 2 * (page_side / 2);
    const auto for_each_node = [&](const auto& visit) {
        for (int i = 0; i < page_side * page_side / 4; ++i)
            visit(page.nodes[static_cast<std::size_t>((first_row + i / (page_side / 2)) * page_side +
                                                      first_column + i % (page_side / 2))]);
    };
    double largest_m = 0.0;
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for_each_node([&](const gpu::MeshletBounds& node) {
        largest_m = std::max(largest_m, static_cast<double>(node.error_m));
        if (node.radius < 0.0F) return;
        low = glm::min(low, glm::dvec3(node.centre));
        high = glm::max(high, glm::dvec3(node.centre));
    });
    quarter.largest_error_m = std::min(rounded_up(error_growth * largest_m), gpu::unfit_error_m);
    if (low.x > high.x) return;
    quarter.centre_m = 0.5 * (low + high);
    for_each_node([&](const gpu::MeshletBounds& node) {
        if (node.radius < 0.0F) return;
        const double reach_m =
            glm::distance(quarter.centre_m, glm::dvec3(node.centre)) + static_cast<double>(node.lod_radius);
        quarter.lod_radius_m = std::max(quarter.lod_radius_m, radius_growth * reach_m);
    });
}

}  // namespace

void sum_up_nodes(PyramidPage& page) {
    sum_up_page(page);
    for (int quarter = 0; quarter < 4; ++quarter) sum_up_quarter(page, quarter);
}

}  // namespace oro
