#include "core/mesh_file/open_sides.h"

#include <algorithm>

namespace oro {

void OpenSides::add(const std::array<std::uint32_t, 3>& triangle) {
    for (std::size_t i = 0; i < 3; ++i) {
        add(triangle[i], triangle[(i + 1) % 3]);
        add(triangle[(i + 1) % 3], triangle[i]);
    }
}

void OpenSides::add(std::uint32_t from, std::uint32_t to) {
    if (from >= first_.size()) first_.resize(std::size_t{from} + 1, none);
    std::size_t seen = 0;
    for (std::uint32_t side = first_[from]; side != none && seen < most_sides;
         side = sides_[side].next, ++seen)
        if (sides_[side].to == to) {
            sides_[side].open = false;
            return;
        }
    sides_.push_back({to, first_[from], true});
    first_[from] = static_cast<std::uint32_t>(sides_.size() - 1);
}

void OpenSides::ends_at(std::uint32_t vertex, std::vector<std::uint32_t>& ends) const {
    if (vertex >= first_.size()) return;
    std::size_t seen = 0;
    for (std::uint32_t side = first_[vertex]; side != none && seen < most_sides;
         side = sides_[side].next, ++seen)
        if (sides_[side].open && std::find(ends.begin(), ends.end(), sides_[side].to) == ends.end())
            ends.push_back(sides_[side].to);
}

}  // namespace oro
