#include "core/mesh_graph/original_pieces.h"

#include <algorithm>

namespace oro {
namespace {

class HandingOn {
  public:
    HandingOn(const NearestTriangles& mesh, DistanceCover& cover, std::span<const glm::dvec3> places,
              PieceTaker& taker)
        : mesh_(mesh), cover_(cover), places_(places), taker_(taker) {}

    void whole(std::uint32_t piece) {
        if (const int user = user_of(piece); user >= 0) taker_.take_whole(piece, user);
    }
    void part(const OriginalPart& part) {
        mark(part.triangle);
        if (const int user = cover_.cover(part); user >= 0) taker_.take_part(part, user);
        take_parts();
    }

  private:
    void mark(std::uint32_t triangle) {
        if (!places_.empty()) cover_.mark(places_[mesh_.number(triangle)]);
    }
    void take_parts() {
        for (const DistanceCover::Taken& one : cover_.taken()) taker_.take_part(one.part, one.user);
        cover_.taken().clear();
    }
    int user_of_triangle(std::uint32_t place) {
        OriginalPart polygon;
        const std::array<glm::dvec3, 3> corners = mesh_.triangle(place);
        std::copy(corners.begin(), corners.end(), polygon.corners.begin());
        polygon.count = 3, polygon.triangle = place, polygon.has_marked = !places_.empty();
        mark(place);
        const int user = cover_.cover(polygon);
        take_parts();
        return user;
    }
    // in_parts: all that is below was handed on.
    int user_of(std::uint32_t piece) {
        const WholePiece whole(piece);
        if (whole.is_triangle()) return user_of_triangle(whole.index);
        std::array<std::uint32_t, 4> below{};
        std::size_t count = 0;
        if (whole.is_block()) {
            const NearestTriangles::Block& block = mesh_.blocks()[whole.index];
            if (const int user = cover_.cover_ball(block.middle, block.radius); user >= 0) return user;
            for (; count < block.count; ++count)
                below[count] = WholePiece::triangle(4 * whole.index + static_cast<std::uint32_t>(count));
        } else {
            const NearestTriangles::Node& node = mesh_.nodes()[whole.index];
            if (const int user = cover_.cover_ball(node.middle, node.radius); user >= 0) return user;
            for (; count < node.count; ++count)
                below[count] = node.is_block ? WholePiece::block(node.below[count])
                                             : WholePiece::node(node.below[count]);
        }
        std::array<int, 4> users{};
        for (std::size_t i = 0; i < count; ++i) users[i] = user_of(below[i]);
        if (users[0] >= 0 &&
            std::all_of(users.begin(), users.begin() + count, [&](int user) { return user == users[0]; }))
            return users[0];
        for (std::size_t i = 0; i < count; ++i)
            if (users[i] >= 0) taker_.take_whole(below[i], users[i]);
        return DistanceCover::in_parts;
    }

    const NearestTriangles& mesh_;
    DistanceCover& cover_;
    std::span<const glm::dvec3> places_;
    PieceTaker& taker_;
};

class IntoMemory final : public PieceTaker {
  public:
    void take_whole(std::uint32_t piece, int user) override { handed.whole.push_back({piece, user}); }
    void take_part(const OriginalPart& part, int user) override { handed.parts.push_back({part, user}); }
    HandedPieces handed;
};

}  // namespace

void join_whole_pieces(const NearestTriangles& mesh, std::vector<std::uint32_t>& whole) {
    const auto parent_of = [&](std::uint32_t piece) {
        const WholePiece one(piece);
        if (one.is_triangle()) return WholePiece::block(one.index / 4);
        const std::uint32_t parent =
            one.is_block() ? mesh.blocks()[one.index].parent : mesh.nodes()[one.index].parent;
        return parent == NearestTriangles::nothing ? parent : WholePiece::node(parent);
    };
    const auto most_below = [&](std::uint32_t parent) {
        const WholePiece one(parent);
        return one.is_block() ? std::size_t{mesh.blocks()[one.index].count}
                              : std::size_t{mesh.nodes()[one.index].count};
    };
    using Child = std::pair<std::uint32_t, std::uint32_t>;  // parent, piece
    std::vector<Child> open;
    for (const std::uint32_t piece : whole) open.emplace_back(parent_of(piece), piece);
    whole.clear();
    while (!open.empty()) {
        std::sort(open.begin(), open.end());
        std::vector<Child> next;
        for (std::size_t i = 0; i < open.size();) {
            std::size_t k = i;
            while (k < open.size() && open[k].first == open[i].first) ++k;
            const std::uint32_t parent = open[i].first;
            if (parent != NearestTriangles::nothing && k - i == most_below(parent))
                next.emplace_back(parent_of(parent), parent);
            else
                for (std::size_t j = i; j < k; ++j) whole.push_back(open[j].second);
            i = k;
        }
        // Pieces that have waited for their siblings get another chance beside what was joined now.
        if (next.empty()) break;
        for (const std::uint32_t piece : whole) next.emplace_back(parent_of(piece), piece);
        whole.clear();
        open = std::move(next);
    }
    std::sort(whole.begin(), whole.end());
}

double hand_on(const NearestTriangles& mesh, std::span<const std::uint32_t> whole, std::size_t parts,
               const std::function<OriginalPart(std::size_t)>& part, DistanceCover& cover,
               std::span<const glm::dvec3> places, PieceTaker& taker) {
    HandingOn handing(mesh, cover, places, taker);
    for (const std::uint32_t piece : whole) handing.whole(piece);
    for (std::size_t i = 0; i < parts; ++i) handing.part(part(i));
    return cover.bound_m();
}

HandedPieces hand_on(const NearestTriangles& mesh, const OriginalPieces& pieces, DistanceCover& cover,
                     std::span<const glm::dvec3> places) {
    IntoMemory taker;
    taker.handed.bound_m = hand_on(
        mesh, pieces.whole, pieces.parts.size(), [&](std::size_t i) { return pieces.parts[i]; }, cover,
        places, taker);
    return std::move(taker.handed);
}

}  // namespace oro
