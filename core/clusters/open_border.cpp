#include "core/clusters/open_border.h"

#include <algorithm>

namespace oro {

OpenBorder::OpenBorder(const OriginalSurface& surface) : surface_(surface) {
    if (!surface.is_window()) return;
    touched_.resize(surface.vertex_count());
    for (std::size_t i = 0; i < touched_.size(); ++i)
        touched_[i] = surface.is_open(static_cast<VertexNumber>(i)) ? 1 : 0;
}

std::vector<char> OpenBorder::complete_groups(const GroupAssignment& assignment,
                                              GroupAssignment::Parts parts) const {
    std::vector<char> whole(assignment.groups(), 1);
    if (touched_.empty()) return whole;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const auto groups = assignment.groups_of(part);
        for (std::size_t i = 0; i < groups.size(); ++i) {
            const VertexTriangle& triangle = parts[part][i];
            if (std::any_of(triangle.begin(), triangle.end(),
                            [&](VertexNumber vertex) { return touched_[vertex] != 0; }))
                whole[groups[i]] = 0;
        }
    }
    for (std::size_t group = 0; group < whole.size(); ++group) {
        const PlaneBox around = assignment.around(group);
        if (std::any_of(reached_.begin(), reached_.end(),
                        [&](const PlaneBox& box) { return box.meets(around); }))
            whole[group] = 0;
    }
    return whole;
}

void OpenBorder::reach(GroupAssignment::Parts made, const std::vector<char>& whole) {
    reached_.clear();
    for (std::size_t group = 0; group < made.size(); ++group) {
        if (whole[group] != 0) continue;
        const SurfaceVertex first = surface_.vertex(made[group].front()[0]);
        PlaneBox box{first.row, first.row, first.column, first.column};
        for (const VertexTriangle& triangle : made[group]) {
            for (const VertexNumber number : triangle) {
                const SurfaceVertex place = surface_.vertex(number);
                box = {std::min<std::int64_t>(box.first_row, place.row),
                       std::max<std::int64_t>(box.last_row, place.row),
                       std::min<std::int64_t>(box.first_column, place.column),
                       std::max<std::int64_t>(box.last_column, place.column)};
                touched_[number] = 1;
            }
        }
        reached_.push_back(box);
    }
}

}  // namespace oro
