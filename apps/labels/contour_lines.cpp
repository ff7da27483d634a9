#include "apps/labels/line_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace oro {
namespace {

constexpr double below_m = 0.01;

// From a node to the next one to the right, or below.
struct Edge {
    int column{};
    int row{};
    bool down{};
    bool operator==(const Edge&) const = default;
};
// Four nodes, by the first of them.
struct Square {
    int column{};
    int row{};
};

class Follower {
  public:
    Follower(const SeenHeights& seen, double apart_m) : seen_(seen), apart_m_(apart_m) {
        steps_.reserve(seen.H_m.size());
        for (const float H_m : seen.H_m)
            steps_.push_back(
                static_cast<std::int32_t>(std::floor((static_cast<double>(H_m) + below_m) / apart_m)));
        followed_.resize(2 * seen.H_m.size());
    }

    std::vector<ContourLine> all() {
        std::vector<ContourLine> lines;
        for (int row = 0; row + 1 < seen_.rows; ++row) {
            for (int column = 0; column + 1 < seen_.columns; ++column) {
                for (const Edge& edge : edges_of({column, row})) {
                    if (followed_[number(edge)] || !is_crossed(edge) || !is_whole({column, row})) continue;
                    lines.push_back(line_through(edge, {column, row}));
                }
            }
        }
        return lines;
    }

  private:
    // Top, right, bottom, left.
    static std::array<Edge, 4> edges_of(const Square& square) {
        const auto [column, row] = square;
        return {
            {{column, row, false}, {column + 1, row, true}, {column, row + 1, false}, {column, row, true}}};
    }
    [[nodiscard]] std::size_t number(const Edge& edge) const {
        return 2 * seen_.at(edge.column, edge.row) + (edge.down ? 1U : 0U);
    }
    [[nodiscard]] std::size_t from(const Edge& edge) const { return seen_.at(edge.column, edge.row); }
    [[nodiscard]] std::size_t to(const Edge& edge) const {
        return edge.down ? seen_.at(edge.column, edge.row + 1) : seen_.at(edge.column + 1, edge.row);
    }
    [[nodiscard]] bool is_crossed(const Edge& edge) const {
        return std::abs(steps_[from(edge)] - steps_[to(edge)]) == 1 && seen_.joined(from(edge), to(edge));
    }
    // Of one piece of ground, and with one line.
    [[nodiscard]] bool is_whole(const Square& square) const {
        std::int32_t low = INT32_MAX, high = INT32_MIN;
        for (const Edge& edge : edges_of(square)) {
            if (!seen_.joined(from(edge), to(edge))) return false;
            for (const std::size_t node : {from(edge), to(edge)}) {
                low = std::min(low, steps_[node]);
                high = std::max(high, steps_[node]);
            }
        }
        return high - low <= 1;
    }
    [[nodiscard]] glm::dvec2 crossing_px(const Edge& edge) const {
        const double first = seen_.H_m[from(edge)], second = seen_.H_m[to(edge)];
        const double level_m = std::max(steps_[from(edge)], steps_[to(edge)]) * apart_m_ - below_m;
        const double share = std::clamp((level_m - first) / (second - first), 0.0, 1.0);
        const glm::dvec2 step = edge.down ? glm::dvec2(0.0, 1.0) : glm::dvec2(1.0, 0.0);
        return seen_.place_px(edge.column, edge.row) + share * seen_.step_px * step;
    }
    // Where the line that comes in through an edge goes out. Of four crossed edges: round the corner that the
    // middle of the square leaves on its side of the line.
    [[nodiscard]] Edge out_of(const Square& square, const Edge& in) const {
        const std::array<Edge, 4> edges = edges_of(square);
        const auto came = static_cast<std::size_t>(std::ranges::find(edges, in) - edges.begin());
        std::size_t others = 0, last = came;
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == came || !is_crossed(edges[i])) continue;
            ++others;
            last = i;
        }
        if (others == 1) return edges[last];
        double middle_m = 0.0;
        for (const std::size_t node : {from(edges[0]), to(edges[0]), from(edges[2]), to(edges[2])})
            middle_m += 0.25 * static_cast<double>(seen_.H_m[node]);
        const std::int32_t middle = static_cast<std::int32_t>(std::floor((middle_m + below_m) / apart_m_));
        const bool as_first = (middle >= std::max(steps_[from(edges[0])], steps_[to(edges[0])])) ==
                              (steps_[from(edges[0])] > steps_[to(edges[0])]);
        // The first node's corner (left and top) is apart where the middle is not as it is.
        constexpr std::array<std::size_t, 4> apart{3, 2, 1, 0}, together{1, 0, 3, 2};
        return edges[as_first ? together[came] : apart[came]];
    }
    [[nodiscard]] std::optional<Square> beyond(const Edge& edge, const Square& square) const {
        Square other = square;
        if (edge.down) {
            other.column = edge.column == square.column ? square.column - 1 : square.column + 1;
        } else {
            other.row = edge.row == square.row ? square.row - 1 : square.row + 1;
        }
        if (other.column < 0 || other.row < 0 || other.column + 1 >= seen_.columns ||
            other.row + 1 >= seen_.rows)
            return std::nullopt;
        return other;
    }
    // From an edge through a square, as far as the line goes on.
    void follow(Edge edge, std::optional<Square> square, std::vector<glm::dvec2>& points) {
        while (square && is_whole(*square)) {
            edge = out_of(*square, edge);
            points.push_back(crossing_px(edge));
            if (followed_[number(edge)]) return;
            followed_[number(edge)] = true;
            square = beyond(edge, *square);
        }
    }
    ContourLine line_through(const Edge& edge, const Square& square) {
        followed_[number(edge)] = true;
        std::vector<glm::dvec2> ahead, behind;
        follow(edge, square, ahead);
        const bool closes = !ahead.empty() && ahead.back() == crossing_px(edge);
        if (!closes) follow(edge, beyond(edge, square), behind);
        ContourLine line;
        line.H_m = std::max(steps_[from(edge)], steps_[to(edge)]) * apart_m_;
        line.points_px.assign(behind.rbegin(), behind.rend());
        line.points_px.push_back(crossing_px(edge));
        line.points_px.insert(line.points_px.end(), ahead.begin(), ahead.end());
        return line;
    }

    const SeenHeights& seen_;
    double apart_m_;
    std::vector<std::int32_t> steps_;  // of each node: how many lines are at or below it
    std::vector<bool> followed_;       // edges
};

}  // namespace

std::vector<ContourLine> contour_lines(const SeenHeights& seen, double apart_m) {
    return Follower(seen, apart_m).all();
}

}  // namespace oro
