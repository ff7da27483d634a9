// Vectors in structs that are shared with shaders.
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

namespace oro {

// Writes a vector's three axes into fields of an array, from `first` on.
template <std::size_t Count>
void put_axes(const glm::dvec3& value, double (&to)[Count], std::size_t first = 0) {
    for (int axis = 0; axis < 3; ++axis) to[first + static_cast<std::size_t>(axis)] = value[axis];
}

}  // namespace oro
