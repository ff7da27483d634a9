#include "core/mesh_graph/mesh_ground.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace oro {
void PartBox::add(const glm::dvec3& place) {
    low = glm::min(low, place), high = glm::max(high, place);
}

double PartBox::diagonal_m() const {
    return glm::distance(low, high);
}

}  // namespace oro
