#include "core/mesh_file/leaf_code.h"

#include <algorithm>

namespace oro {
namespace {

bool has_corner(const std::array<std::uint32_t, 3>& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
}

}  // namespace

void LeafCode::begin(std::uint32_t count, const LeafSource& source) {
    open_.clear(), recorded_.clear(), local_.clear();
    is_recorded_.assign(source.triangles.empty() ? 0 : count, 0);
}

// The triangle of the source that is not told yet and has that side; none: there is none.
LeafCode::Recorded LeafCode::at_side(const LeafSource& source, const Side& side) const {
    Recorded found;
    const std::uint32_t from = source_of_[side.from], to = source_of_[side.to];
    for (std::uint32_t i = 0; i < source.triangles.size(); ++i) {
        const Triangle& triangle = source.triangles[i];
        if (is_recorded_[i] != 0 || !has_corner(triangle, from) || !has_corner(triangle, to)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
            if (a == to && b == from) return {{to, from, c}, i, false};
            if (a == from && b == to && found.number == none) found = {{from, to, c}, i, true};
        }
    }
    return found;
}

// One that is not told yet, of most vertices that are known.
LeafCode::Recorded LeafCode::first_left(const LeafSource& source) const {
    Recorded best;
    int most = -1;
    for (std::uint32_t i = 0; i < source.triangles.size(); ++i) {
        if (is_recorded_[i] != 0) continue;
        const Triangle& triangle = source.triangles[i];
        const auto is_known = [&](std::size_t k) {
            return triangle[k % 3] < number_of_.size() && number_of_[triangle[k % 3]] != none ? 1 : 0;
        };
        const int known = is_known(0) + is_known(1) + is_known(2);
        if (known <= most) continue;
        most = known;
        std::size_t first = 0;
        while (first < 2 && known > 0 && (is_known(first) == 0 || (known == 2 && is_known(first + 1) == 0)))
            ++first;
        best = {{triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]}, i, false};
    }
    return best;
}

template <class Coder>
void LeafCode::place(Coder& coder, const Side* side, const LatticeSteps* value, CodedMesh<Coder>& mesh) {
    LatticeSteps at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto above = [&](std::uint32_t known) {
            return static_cast<std::uint32_t>(mesh.places[known][axis] - least_[axis]);
        };
        std::uint32_t near = 0;
        if (side != nullptr)
            near = above(side->from) + above(side->to) - above(side->third);
        else if (!mesh.places.empty())
            near = above(static_cast<std::uint32_t>(mesh.places.size() - 1));
        std::uint32_t there = 0;
        if constexpr (Coder::writes) there = static_cast<std::uint32_t>((*value)[axis] - least_[axis]);
        const auto away = static_cast<std::int32_t>(there - near);
        near += static_cast<std::uint32_t>(away_[side != nullptr ? 1 : 0][axis].code(coder, away));
        at[axis] = least_[axis] + static_cast<std::int64_t>(near);
    }
    mesh.places.push_back(at);
}

// known: those of the triangle that are told already. side: that it hangs at; null: at none.
template <class Coder>
std::uint32_t LeafCode::vertex(Coder& coder, std::span<const std::uint32_t> known,
                               std::uint32_t source_vertex, std::span<const LatticeSteps> source_places,
                               const Side* side, CodedMesh<Coder>& mesh) {
    const auto next = static_cast<std::uint32_t>(mesh.places.size());
    ends_.clear();
    for (const std::uint32_t one : known) sides_of_all_.ends_at(one, ends_);
    std::erase_if(ends_, [&](std::uint32_t end) {
        return std::find(known.begin(), known.end(), end) != known.end() ||
               (side != nullptr && end == side->third);
    });
    std::uint32_t number = none;
    if constexpr (Coder::writes) {
        if (source_vertex >= number_of_.size()) number_of_.resize(std::size_t{source_vertex} + 1, none);
        number = number_of_[source_vertex];
    }
    const std::size_t some = std::min<std::size_t>(ends_.size(), 3);
    const bool can_be_new = next<vertex_count_, can_be_old = next> known.size();
    if (!can_be_old && !can_be_new) return none;
    bool is_new = !can_be_old;
    if (can_be_new && can_be_old)
        is_new = coder.bit(is_new_[some + (side != nullptr ? 4U : 0U)], number == none);
    if (is_new) {
        const LatticeSteps* value = nullptr;
        if constexpr (Coder::writes) {
            value = &source_places[source_vertex];
            number_of_[source_vertex] = next;
            source_of_.push_back(source_vertex);
        }
        place(coder, side, value, mesh);
        return next;
    }
    const auto found = std::find(ends_.begin(), ends_.end(), number);
    if (!ends_.empty() && coder.bit(is_end_[some], found != ends_.end())) {
        const std::uint32_t which = which_end_.code(coder, static_cast<std::uint32_t>(found - ends_.begin()));
        return which < ends_.size() ? ends_[which] : none;
    }
    if (!local_.empty()) {
        const auto here = std::find(local_.begin(), local_.end(), number);
        if (coder.bit(local_known_, here != local_.end()))
            return local_[coder.uniform(static_cast<std::uint32_t>(local_.size()),
                                        static_cast<std::uint32_t>(here - local_.begin()))];
    }
    return coder.uniform(next, number);
}

// Its sides are open, but for those that are open already: these are closed.
void LeafCode::add_sides(const Triangle& corners, std::uint32_t label, bool has_first) {
    for (std::size_t i = has_first ? 1 : 0; i < 3; ++i) {
        const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
        const auto same = std::find_if(open_.begin(), open_.end(), [&](const Side& side) {
            return (side.from == to && side.to == from) || (side.from == from && side.to == to);
        });
        if (same != open_.end())
            open_.erase(same);
        else
            open_.push_back({from, to, corners[(i + 2) % 3], label});
    }
}

template <class Coder>
bool LeafCode::code(Coder& coder, std::uint32_t count, const LeafSource& source,
                    std::span<const LatticeSteps> source_places, CodedMesh<Coder>& mesh) {
    begin(count, source);
    for (std::uint32_t done = 0; done < count;) {
        const bool is_first = open_.empty();
        Side side{};
        Recorded next;
        if (!is_first) {
            side = open_.back();
            open_.pop_back();
            if constexpr (Coder::writes) next = at_side(source, side);
            if (!coder.bit(more_, next.number != none)) continue;
        } else if constexpr (Coder::writes) {
            next = first_left(source);
        }
        Triangle corners{none, none, none};
        if (is_first) {
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] =
                    vertex(coder, std::span(corners).first(i), next.corners[i], source_places, nullptr, mesh);
                if (corners[i] == none) return false;
            }
        } else {
            const bool is_turned = coder.bit(turned_, next.is_turned);
            corners[0] = is_turned ? side.from : side.to, corners[1] = is_turned ? side.to : side.from;
            corners[2] =
                vertex(coder, std::span(corners).first(2), next.corners[2], source_places, &side, mesh);
        }
        if (corners[2] == none || corners[0] == corners[1] || corners[1] == corners[2] ||
            corners[2] == corners[0])
            return false;
        std::uint32_t label = 0;
        if (label_count_ > 0) {
            if constexpr (Coder::writes) label = source.labels[next.number];
            if (is_first || !coder.bit(same_label_, label == side.label))
                label = coder.uniform(label_count_, label);
            else
                label = side.label;
            mesh.labels.push_back(label);
        }
        if constexpr (Coder::writes) is_recorded_[next.number] = 1, recorded_.push_back(next.number);
        for (const std::uint32_t corner : corners)
            if (std::find(local_.begin(), local_.end(), corner) == local_.end()) local_.push_back(corner);
        add_sides(corners, label, !is_first);
        sides_of_all_.add(corners);
        triangles_of(mesh).push_back(corners);
        ++done;
        if constexpr (!Coder::writes)
            if (coder.is_wrong()) return false;
    }
    return true;
}

template bool LeafCode::code(RangeEncoder&, std::uint32_t, const LeafSource&, std::span<const LatticeSteps>,
                             WrittenMesh&);
template bool LeafCode::code(RangeDecoder&, std::uint32_t, const LeafSource&, std::span<const LatticeSteps>,
                             StoredMesh&);

}  // namespace oro
