#include "core/clusters/group_assignment.h"

#include <algorithm>
#include <iterator>

namespace oro {

GroupAssignment::GroupAssignment(const OriginalSurface& surface, Parts parts, const GroupTiling& tiling,
                                 bool in_one, VertexLocks& locks)
    : tiling_(tiling) {
    first_.push_back(0);
    for (const auto& part : parts) first_.push_back(first_.back() + part.size());
    if (in_one) {
        group_.assign(first_.back(), 0);
        groups_ = 1;
    } else {
        join_kept(parts, locks);
        choose_tiles(surface, parts, locks);
    }
    lock_borders(parts, locks);
}

VertexNumber GroupAssignment::first_of_kept(VertexNumber vertex) {
    VertexNumber& before = kept_.at(vertex);
    if (before != vertex) before = first_of_kept(before);
    return before;
}

void GroupAssignment::join_kept(Parts parts, const VertexLocks& locks) {
    for (const auto& part : parts) {
        for (const VertexTriangle& triangle : part) {
            const VertexNumber* last = nullptr;
            for (const VertexNumber& vertex : triangle) {
                if (locks.levels(vertex) < 2) continue;
                kept_.emplace(vertex, vertex);
                if (last != nullptr) {
                    const VertexNumber a = first_of_kept(*last), b = first_of_kept(vertex);
                    kept_[std::max(a, b)] = std::min(a, b);
                }
                last = &vertex;
            }
        }
    }
}

void GroupAssignment::choose_tiles(const OriginalSurface& surface, Parts parts, const VertexLocks& locks) {
    std::vector<GroupTile> tiles;
    tiles.reserve(first_.back());
    for (const auto& part : parts) {
        for (const VertexTriangle& triangle : part) {
            const auto kept = std::find_if(triangle.begin(), triangle.end(),
                                           [&](VertexNumber vertex) { return locks.levels(vertex) >= 2; });
            if (kept != triangle.end())
                tiles.push_back(tiling_.tile_of(surface.vertex(first_of_kept(*kept))));
            else
                tiles.push_back(tiling_.tile_of(surface.vertex(triangle[0]), surface.vertex(triangle[1]),
                                                surface.vertex(triangle[2])));
        }
    }
    std::unique_copy(tiles.begin(), tiles.end(), std::back_inserter(tiles_));
    std::sort(tiles_.begin(), tiles_.end());
    tiles_.erase(std::unique(tiles_.begin(), tiles_.end()), tiles_.end());
    groups_ = tiles_.size();
    group_.reserve(tiles.size());
    const GroupTile* last = nullptr;
    for (const GroupTile& tile : tiles) {
        if (last != nullptr && *last == tile) {
            group_.push_back(group_.back());
        } else {
            group_.push_back(static_cast<std::uint32_t>(std::lower_bound(tiles_.begin(), tiles_.end(), tile) -
                                                        tiles_.begin()));
        }
        last = &tile;
    }
}

void GroupAssignment::lock_borders(Parts parts, VertexLocks& locks) const {
    locks.begin_level();
    std::size_t i = 0;
    for (const auto& part : parts) {
        for (const VertexTriangle& triangle : part) {
            for (const VertexNumber vertex : triangle) locks.see(vertex, group_[i]);
            ++i;
        }
    }
    locks.end_level();
}

void VertexLocks::begin_level() {
    std::fill(group_.begin(), group_.end(), unseen);
}

void VertexLocks::end_level() {
    locked_ = locked_twice_ = 0;
    for (std::size_t vertex = 0; vertex < group_.size(); ++vertex) {
        std::uint8_t& levels = levels_[vertex];
        levels = group_[vertex] == shared ? static_cast<std::uint8_t>(levels + 1) : std::uint8_t{0};
        locked_ += levels > 0 ? 1U : 0U;
        locked_twice_ += levels > 1 ? 1U : 0U;
    }
}

}  // namespace oro
