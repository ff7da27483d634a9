#include "apps/labels/line_labels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace oro {
namespace {

constexpr double every_px = 2.0;       // places that are tried along a line
constexpr double most_H_share = 0.95;  // of an interval: how far H may be from the line's below a label
constexpr double own_apart = 20.0, turned_apart = 40.0, all_apart = 8.0;  // sizes between labels

// One that could be written.
struct Candidate {
    double cost{};
    std::size_t line{};
    std::size_t point{};
    LineLabel label;
};

// Points of a line, one pixel apart along it.
std::vector<glm::dvec2> evenly(const std::vector<glm::dvec2>& points) {
    std::vector<glm::dvec2> even;
    if (points.empty()) return even;
    even.push_back(points.front());
    double left_px = 1.0;  // to the next one
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 from = points[i - 1], step = points[i] - from;
        const double length_px = glm::length(step);
        double at_px = left_px;
        for (; at_px <= length_px; at_px += 1.0) even.push_back(from + step * (at_px / length_px));
        left_px = at_px - length_px;
    }
    return even;
}

// The direction of the part of a line that reaches so many points to both sides, by least squares; nothing
// where it bends.
struct Straight {
    glm::dvec2 along;
    double off_px;
};
std::optional<Straight> straight_at(const std::vector<glm::dvec2>& points, std::size_t middle,
                                    std::size_t reach, double most_off_px) {
    if (middle < reach || middle + reach >= points.size()) return std::nullopt;
    glm::dvec2 sum(0.0);
    for (std::size_t i = 1; i <= reach; ++i)
        sum += static_cast<double>(i) * (points[middle + i] - points[middle - i]);
    if (sum == glm::dvec2(0.0)) return std::nullopt;
    const glm::dvec2 along = glm::normalize(sum);
    double off_px = 0.0;
    for (std::size_t i = middle - reach; i <= middle + reach; ++i) {
        const glm::dvec2 away = points[i] - points[middle];
        off_px = std::max(off_px, std::abs(away.x * along.y - away.y * along.x));
        if (off_px > most_off_px) return std::nullopt;
    }
    // A line that turns back and forth is longer than the label.
    if (glm::dot(points[middle + reach] - points[middle - reach], along) <
        0.93 * 2.0 * static_cast<double>(reach))
        return std::nullopt;
    return Straight{along, off_px};
}

class Places {
  public:
    Places(const SeenHeights& seen, double interval_m, double size_px)
        : seen_(seen), interval_m_(interval_m), size_px_(size_px) {}

    // All places of a line, both those with the top uphill and others.
    void add(const ContourLine& line, std::size_t number, const std::string& text, double length_px,
             std::vector<Candidate>& all) const {
        const std::vector<glm::dvec2> points = evenly(line.points_px);
        const auto reach = static_cast<std::size_t>(std::ceil(0.5 * length_px + 0.45 * size_px_));
        std::vector<Candidate> uphill, turned;
        for (std::size_t at = reach; at + reach < points.size(); at += static_cast<std::size_t>(every_px)) {
            const auto straight = straight_at(points, at, reach, most_line_off_share * size_px_);
            if (!straight) continue;
            auto label = label_at(points[at], straight->along, length_px);
            if (!label) continue;
            const auto crowd = H_share_below(*label, line.H_m);
            if (!crowd) continue;
            label->text = text;
            label->H_m = line.H_m;
            const double cost = straight->off_px / (most_line_off_share * size_px_) + *crowd +
                                0.5 * std::abs(label->angle_deg) / 90.0 + (label->top_is_uphill ? 0.0 : 10.0);
            (label->top_is_uphill ? uphill : turned).push_back({cost, number, at, *label});
        }
        const std::vector<Candidate>& taken = uphill.empty() ? turned : uphill;
        all.insert(all.end(), taken.begin(), taken.end());
    }

  private:
    // Nothing where uphill is not known, or too near to the border.
    [[nodiscard]] std::optional<LineLabel> label_at(const glm::dvec2& middle_px, glm::dvec2 along,
                                                    double length_px) const {
        glm::dvec2 up(along.y, -along.x);
        const double offset_px = 0.3 * size_px_;
        const auto above = seen_.H_at(middle_px + offset_px * up),
                   below = seen_.H_at(middle_px - offset_px * up);
        if (!above || !below || *above == *below) return std::nullopt;
        if (*above < *below) {
            up = -up;
            along = -along;
        }
        const bool readable = up.y <= 0.0;
        if (!readable) along = -along;
        const glm::dvec2 half = glm::abs(along) * 0.5 * length_px + glm::abs(up) * 0.5 * size_px_;
        const glm::dvec2 size(seen_.columns * seen_.step_px, seen_.rows * seen_.step_px);
        const glm::dvec2 low = middle_px - half - size_px_, high = middle_px + half + size_px_;
        if (low.x < 0.0 || low.y < 0.0 || high.x > size.x || high.y > size.y) return std::nullopt;
        LineLabel label;
        label.middle_px = middle_px;
        label.angle_deg = std::atan2(along.y, along.x) * 180.0 / std::numbers::pi;
        label.length_px = length_px;
        label.top_is_uphill = readable;
        return label;
    }

    // Below a label: how far H is from its line's at most, in intervals; nothing where ground ends or breaks
    // off there or near by, or another line passes.
    [[nodiscard]] std::optional<double> H_share_below(const LineLabel& label, double H_m) const {
        const double radians = label.angle_deg * std::numbers::pi / 180.0;
        const glm::dvec2 along(std::cos(radians), std::sin(radians)), across(-along.y, along.x);
        // The figures and some of their halo, and what is around them.
        const glm::dvec2 figures(0.5 * label.length_px + 0.15 * size_px_, 0.43 * size_px_),
            around = figures + glm::dvec2(0.4 * size_px_);
        const glm::dvec2 half = glm::abs(along) * around.x + glm::abs(across) * around.y;
        const auto node = [&](double px) { return static_cast<int>(std::floor((px - 0.5) / seen_.step_px)); };
        const glm::dvec2 low = label.middle_px - half, high = label.middle_px + half;
        double most = 0.0;
        for (int row = node(low.y); row <= node(high.y) + 1; ++row) {
            for (int column = node(low.x); column <= node(high.x) + 1; ++column) {
                const glm::dvec2 away = seen_.place_px(column, row) - label.middle_px;
                const glm::dvec2 off = glm::abs(glm::dvec2(glm::dot(away, along), glm::dot(away, across)));
                if (glm::any(glm::greaterThan(off, around + 0.5 * seen_.step_px))) continue;
                if (!goes_on(column, row)) return std::nullopt;
                if (glm::any(glm::greaterThan(off, figures + 0.5 * seen_.step_px))) continue;
                const double H_here_m = seen_.H_m[seen_.at(column, row)];
                most = std::max(most, std::abs(H_here_m - H_m) / interval_m_);
                if (most > most_H_share) return std::nullopt;
            }
        }
        return most;
    }
    [[nodiscard]] bool goes_on(int column, int row) const {
        if (column < 0 || row < 0 || column + 1 >= seen_.columns || row + 1 >= seen_.rows) return false;
        const std::size_t here = seen_.at(column, row);
        return seen_.joined(here, seen_.at(column + 1, row)) && seen_.joined(here, seen_.at(column, row + 1));
    }

    const SeenHeights& seen_;
    double interval_m_;
    double size_px_;
};

// Labels that were taken, by squares of the picture, so that only those near by are asked.
class Taken {
  public:
    explicit Taken(double size_px) : size_px_(size_px) {}

    bool take(const LineLabel& label) {
        const auto [column, row] = square_of(label.middle_px);
        for (int down = -1; down <= 1; ++down) {
            for (int right = -1; right <= 1; ++right) {
                const auto there = squares_.find({column + right, row + down});
                if (there == squares_.end()) continue;
                for (const LineLabel& other : there->second) {
                    if (glm::length(other.middle_px - label.middle_px) < apart_px(label, other)) return false;
                }
            }
        }
        squares_[{column, row}].push_back(label);
        return true;
    }

  private:
    // No more than the side of a square.
    [[nodiscard]] double apart_px(const LineLabel& one, const LineLabel& other) const {
        const bool turned = !one.top_is_uphill || !other.top_is_uphill;
        if (one.text == other.text) return (turned ? turned_apart : own_apart) * size_px_;
        return std::min(own_apart * size_px_,
                        std::max(all_apart * size_px_, one.length_px + other.length_px));
    }
    [[nodiscard]] std::pair<int, int> square_of(const glm::dvec2& place_px) const {
        const glm::dvec2 square = glm::floor(place_px / (turned_apart * size_px_));
        return {static_cast<int>(square.x), static_cast<int>(square.y)};
    }
    double size_px_;
    std::map<std::pair<int, int>, std::vector<LineLabel>> squares_;
};

}  // namespace

Result<std::vector<LineLabel>> line_labels(const SeenHeights& seen, double interval_m, double size_px,
                                           const TextLength& length) {
    const std::vector<ContourLine> lines = contour_lines(seen, 5.0 * interval_m);
    const Places places(seen, interval_m, size_px);
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double whole_m = std::round(lines[i].H_m);
        // The interval is a float: 0.1 m is not quite that.
        if (std::abs(lines[i].H_m - whole_m) > 1e-6 * std::max(std::abs(whole_m), interval_m)) continue;
        const std::string text = std::to_string(static_cast<long long>(whole_m));
        ORO_TRY(const double length_px, length(text));
        places.add(lines[i], i, text, length_px, candidates);
    }
    std::ranges::sort(candidates, {}, [](const Candidate& candidate) {
        return std::tuple(candidate.cost, candidate.line, candidate.point);
    });
    Taken taken(size_px);
    std::vector<LineLabel> labels;
    for (const Candidate& candidate : candidates) {
        if (taken.take(candidate.label)) labels.push_back(candidate.label);
    }
    std::ranges::sort(labels, {},
                      [](const LineLabel& label) { return std::pair(label.middle_px.y, label.middle_px.x); });
    return labels;
}

}  // namespace oro
