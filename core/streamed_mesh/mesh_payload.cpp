#include "core/streamed_mesh/mesh_payload.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "core/cluster_file/number_code.h"
#include "core/mesh_file/open_sides.h"
#include "core/streamed_mesh/place_code.h"

namespace oro {
namespace {

using Corners = std::array<std::uint32_t, 3>;
constexpr std::uint32_t no_vertex = ~std::uint32_t{0};

// Both ways. Triangles come in the order that they have. Coded of each is at which of the last open sides it
// hangs, and which vertex it has beyond.
template <class Coder>
class PayloadCode {
  public:
    PayloadCode(Coder& coder, const PayloadShape& shape, const MeshPayload* source, MeshPayload& payload)
        : coder_(coder), shape_(shape), source_(source), payload_(payload), beside_(coder, shape.least) {}

    // False where a decoder's bytes tell none.
    bool code() {
        for (const std::uint32_t count : shape_.clusters)
            for (std::uint32_t i = 0; i < count; ++i)
                if (!triangle()) return false;
        return true;
    }

  private:
    struct Side {
        std::uint32_t from, to, third, label;  // as the triangle goes round; its other vertex
    };
    static constexpr std::size_t most_sides = 48;  // that are looked at

    [[nodiscard]] std::size_t sides_in_reach() const { return std::min(open_.size(), most_sides); }
    [[nodiscard]] const Side& side_at(std::size_t rank) const { return open_[open_.size() - 1 - rank]; }
    bool triangle();
    // An encoder's: the last open side that a triangle hangs at; its number is sides_in_reach() where none
    // is.
    struct Hanging {
        std::size_t rank{};
        std::size_t first{};  // corner that the side begins or ends at
        bool is_turned{};
    };
    [[nodiscard]] Hanging hanging(const Corners& corners) const;
    std::uint32_t vertex(std::span<const std::uint32_t> known, std::uint32_t value, const Side* side);
    void place(const Side* side, std::uint32_t value);
    bool place_in_town(std::span<const std::uint32_t> known, const Side* side, std::uint32_t value);
    void colour(std::uint32_t value);
    bool label(const Side* side);
    void add(const Corners& corners, std::uint32_t label);

    Coder& coder_;
    PayloadShape shape_;
    const MeshPayload* source_;
    MeshPayload& payload_;
    std::vector<Side> open_;
    OpenSides sides_of_all_;
    std::vector<std::uint32_t> ends_;
    SmallNumber rank_, which_end_;
    FewNumbers first_;
    AdaptiveBit turned_, same_label_, has_colour_;
    // Of a town alone.
    PlaceCode<Coder> beside_;
    AdaptiveBit hangs_;
    NearZero label_away_;
    std::array<AdaptiveBit, 2> is_new_;
    std::array<AdaptiveBit, 4> is_end_;
    std::array<std::array<NearZero, 3>, 2> away_;
    std::array<NearZero, 3> colour_away_;
};

template <class Coder>
typename PayloadCode<Coder>::Hanging PayloadCode<Coder>::hanging(const Corners& corners) const {
    const std::size_t count = sides_in_reach();
    for (std::size_t rank = 0; rank < count; ++rank)
        for (std::size_t first = 0; first < 3; ++first) {
            const std::uint32_t a = corners[first], b = corners[(first + 1) % 3];
            const Side& side = side_at(rank);
            if (a == side.to && b == side.from) return {rank, first, false};
            if (a == side.from && b == side.to) return {rank, first, true};
        }
    return {count, 0, false};
}

template <class Coder>
void PayloadCode<Coder>::place(const Side* side, std::uint32_t value) {
    LatticeSteps at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto above = [&](std::uint32_t known) {
            return static_cast<std::uint32_t>(payload_.places[known][axis] - shape_.least[axis]);
        };
        std::uint32_t near = 0;
        if (side != nullptr)
            near = above(side->from) + above(side->to) - above(side->third);
        else if (!payload_.places.empty())
            near = above(static_cast<std::uint32_t>(payload_.places.size() - 1));
        std::uint32_t there = 0;
        if constexpr (Coder::writes)
            there = static_cast<std::uint32_t>(source_->places[value][axis] - shape_.least[axis]);
        const auto away = static_cast<std::int32_t>(there - near);
        near += static_cast<std::uint32_t>(away_[side != nullptr ? 1 : 0][axis].code(coder_, away));
        at[axis] = shape_.least[axis] + static_cast<std::int64_t>(near);
    }
    payload_.places.push_back(at);
}

template <class Coder>
bool PayloadCode<Coder>::place_in_town(std::span<const std::uint32_t> known, const Side* side,
                                       std::uint32_t value) {
    typename PlaceCode<Coder>::Known there;
    for (const std::uint32_t one : known) there.corners[there.count++] = payload_.places[one];
    there.last = payload_.places.empty() ? shape_.least : payload_.places.back();
    there.hangs = side != nullptr;
    if (side != nullptr) there.third = payload_.places[side->third];
    LatticeSteps place{};
    if constexpr (Coder::writes) place = source_->places[value];
    LatticeSteps at{};
    if (!beside_.code(there, place, at)) return false;
    payload_.places.push_back(at);
    return true;
}

// Of a new vertex, beside the last one's.
template <class Coder>
void PayloadCode<Coder>::colour(std::uint32_t value) {
    const VertexColour last = payload_.colours.empty() ? VertexColour{} : payload_.colours.back();
    VertexColour there{};
    if constexpr (Coder::writes) there = source_->colours[value];
    const bool is_stated = coder_.bit(has_colour_, there.is_stated != 0);
    VertexColour found{0, 0, 0, static_cast<std::uint8_t>(is_stated ? 1 : 0)};
    const auto code = [&](std::size_t channel, std::uint8_t before, std::uint8_t now) {
        const int away = colour_away_[channel].code(coder_, static_cast<int>(now) - static_cast<int>(before));
        return static_cast<std::uint8_t>(static_cast<std::uint32_t>(before) +
                                         static_cast<std::uint32_t>(away));
    };
    found.red = code(0, last.red, there.red);
    found.green = code(1, last.green, there.green);
    found.blue = code(2, last.blue, there.blue);
    payload_.colours.push_back(found);
}

// A vertex of a triangle: a new one, one that an open side leads to from those known, or any other.
template <class Coder>
std::uint32_t PayloadCode<Coder>::vertex(std::span<const std::uint32_t> known, std::uint32_t value,
                                         const Side* side) {
    const auto next = static_cast<std::uint32_t>(payload_.places.size());
    bool is_new = next <= known.size();
    if (!is_new) is_new = coder_.bit(is_new_[side != nullptr ? 1 : 0], value == next);
    if (is_new) {
        if (next > std::numeric_limits<std::uint16_t>::max()) return no_vertex;
        if (!shape_.is_town)
            place(side, value);
        else if (!place_in_town(known, side, value))
            return no_vertex;
        if (shape_.has_colours) colour(value);
        return next;
    }
    ends_.clear();
    for (const std::uint32_t one : known) sides_of_all_.ends_at(one, ends_);
    std::erase_if(ends_, [&](std::uint32_t end) {
        return std::find(known.begin(), known.end(), end) != known.end() ||
               (side != nullptr && end == side->third);
    });
    const auto found = std::find(ends_.begin(), ends_.end(), value);
    const std::size_t some = std::min<std::size_t>(ends_.size(), 3);
    if (!ends_.empty() && coder_.bit(is_end_[some], found != ends_.end())) {
        const std::uint32_t which =
            which_end_.code(coder_, static_cast<std::uint32_t>(found - ends_.begin()));
        return which < ends_.size() ? ends_[which] : no_vertex;
    }
    return coder_.uniform(next, value);
}

template <class Coder>
bool PayloadCode<Coder>::label(const Side* side) {
    if (shape_.label_count == 0) return true;
    std::uint32_t value = 0;
    if constexpr (Coder::writes) value = source_->labels[payload_.labels.size()];
    const bool is_first = payload_.labels.empty();
    const std::uint32_t near = side != nullptr ? side->label : is_first ? 0 : payload_.labels.back();
    if (!is_first && coder_.bit(same_label_, value == near))
        value = near;
    else if (shape_.is_town && !is_first)
        value = near +
                static_cast<std::uint32_t>(label_away_.code(coder_, static_cast<std::int32_t>(value - near)));
    else
        value = coder_.uniform(shape_.label_count, value);
    payload_.labels.push_back(value);
    return value < shape_.label_count;
}

// Its sides are open, but for those that are open already: these are closed.
template <class Coder>
void PayloadCode<Coder>::add(const Corners& corners, std::uint32_t label) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = corners[i], to = corners[(i + 1) % 3];
        const auto end = open_.rbegin() + static_cast<std::ptrdiff_t>(sides_in_reach());
        const auto same = std::find_if(open_.rbegin(), end, [&](const Side& side) {
            return (side.from == to && side.to == from) || (side.from == from && side.to == to);
        });
        if (same != end)
            open_.erase(std::next(same).base());
        else
            open_.push_back({from, to, corners[(i + 2) % 3], label});
    }
    sides_of_all_.add(corners);
    if (shape_.is_town)
        beside_.add_triangle(
            {payload_.places[corners[0]], payload_.places[corners[1]], payload_.places[corners[2]]});
}

template <class Coder>
bool PayloadCode<Coder>::triangle() {
    Corners there{};
    Hanging at;
    if constexpr (Coder::writes) {
        const std::array<std::uint16_t, 3>& triangle = source_->triangles[payload_.triangles.size()];
        there = {triangle[0], triangle[1], triangle[2]};
        at = hanging(there);
    }
    const std::size_t count = sides_in_reach();
    // 0 is the last side; that there is none comes behind all, or is told before.
    if (count > 0 && shape_.is_town && !coder_.bit(hangs_, at.rank < count))
        at.rank = count;
    else if (count > 0)
        at.rank = rank_.code(coder_, static_cast<std::uint32_t>(at.rank));
    if (at.rank > count) return false;
    Corners corners{no_vertex, no_vertex, no_vertex};
    std::optional<Side> side;
    if (count > 0 && at.rank < count) {
        side = side_at(at.rank);
        at.first = first_.code(coder_, 2, static_cast<std::uint32_t>(at.first));
        at.is_turned = coder_.bit(turned_, at.is_turned);
        if (at.first > 2) return false;
        const std::size_t second = (at.first + 1) % 3, third = (at.first + 2) % 3;
        corners[at.first] = at.is_turned ? side->from : side->to;
        corners[second] = at.is_turned ? side->to : side->from;
        const std::array<std::uint32_t, 2> known{corners[at.first], corners[second]};
        corners[third] = vertex(known, there[third], &*side);
    } else {
        for (std::size_t i = 0; i < 3; ++i)
            if (corners[i] = vertex(std::span(corners).first(i), there[i], nullptr); corners[i] == no_vertex)
                return false;
    }
    for (std::size_t i = 0; i < 3; ++i)
        if (corners[i] == no_vertex || corners[i] == corners[(i + 1) % 3]) return false;
    if (!label(side ? &*side : nullptr)) return false;
    add(corners, payload_.labels.empty() ? 0 : payload_.labels.back());
    payload_.triangles.push_back({static_cast<std::uint16_t>(corners[0]),
                                  static_cast<std::uint16_t>(corners[1]),
                                  static_cast<std::uint16_t>(corners[2])});
    if constexpr (Coder::writes)
        return true;
    else
        return !coder_.is_wrong();
}

glm::dvec3 between(const LatticeSteps& from, const LatticeSteps& to) {
    return {static_cast<double>(to[0] - from[0]), static_cast<double>(to[1] - from[1]),
            static_cast<double>(to[2] - from[2])};
}

bool has_flat(const MeshPayload& payload) {
    return std::ranges::any_of(payload.triangles, [&](const auto& one) {
        return glm::cross(between(payload.places[one[0]], payload.places[one[1]]),
                          between(payload.places[one[0]], payload.places[one[2]])) == glm::dvec3(0.0);
    });
}

// Whether a cluster has more vertices than one may have.
bool is_too_full(const MeshPayload& payload, std::span<const std::uint32_t> clusters) {
    std::vector<std::uint32_t> counted_by(payload.places.size(), 0);
    std::uint32_t cluster = 0;
    std::size_t first = 0;
    for (const std::uint32_t count : clusters) {
        std::size_t vertices = 0;
        ++cluster;
        for (std::size_t i = first; i < first + count; ++i)
            for (const std::uint16_t corner : payload.triangles[i]) {
                vertices += counted_by[corner] == cluster ? 0U : 1U;
                counted_by[corner] = cluster;
            }
        if (vertices > most_cluster_vertices) return true;
        first += count;
    }
    return false;
}

}  // namespace

std::uint64_t MeshPayload::held_bytes() const {
    constexpr std::uint64_t of_itself = 256;
    return of_itself + places.capacity() * sizeof(LatticeSteps) + colours.capacity() * sizeof(VertexColour) +
           triangles.capacity() * sizeof(triangles[0]) + labels.capacity() * sizeof(labels[0]);
}

std::optional<std::string> wrong_with_triangles(const MeshPayload& payload,
                                                std::span<const std::uint32_t> clusters) {
    if (has_flat(payload)) return "has a triangle without an area";
    if (is_too_full(payload, clusters))
        return "has a cluster of more than " + std::to_string(most_cluster_vertices) + " vertices";
    return std::nullopt;
}

std::vector<std::byte> payload_to_bytes(const PayloadShape& shape, const MeshPayload& payload) {
    RangeEncoder coder;
    MeshPayload coded;
    PayloadCode<RangeEncoder>(coder, shape, &payload, coded).code();
    return coder.finish();
}

std::optional<std::string> payload_from_bytes(std::span<const std::byte> bytes, const PayloadShape& shape,
                                              MeshPayload& payload) {
    payload = {};
    RangeDecoder coder(bytes);
    if (!PayloadCode<RangeDecoder>(coder, shape, nullptr, payload).code())
        return "has a triangle that is none";
    if (coder.is_wrong()) return "is cut off";
    if (!coder.at_end()) return "goes on after its last triangle";
    if (auto wrong = wrong_with_triangles(payload, shape.clusters)) return wrong;
    payload.labels.shrink_to_fit(), payload.places.shrink_to_fit(), payload.colours.shrink_to_fit(),
        payload.triangles.shrink_to_fit();
    return std::nullopt;
}

}  // namespace oro
