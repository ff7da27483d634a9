#include "apps/trade_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace oro {
namespace {

constexpr double label_height_px = 15.0;
constexpr double point_radius_px = 6.0;
constexpr double leader_from_px = 14.0;  // distance from which on a line joins label and point

bool overlap(const PlotBox& a, const PlotBox& b) {
    return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

bool inside(const PlotBox& box, const PlotBox& room) {
    return box.left >= room.left && box.right <= room.right && box.top >= room.top &&
           box.bottom <= room.bottom;
}

PlotBox around(const PlotPlace& place, double half_px) {
    return {place.x - half_px, place.y - half_px, place.x + half_px, place.y + half_px};
}

// Clips the stretch to the box. Source: Liang and Barsky, 1984.
bool crosses(const PlotBox& box, const PlotPlace& from, const PlotPlace& to) {
    double enter = 0.0;
    double leave = 1.0;
    const auto clip = [&](double step, double room) {
        if (step == 0.0) return room >= 0.0;
        const double at = room / step;
        if (step < 0.0)
            enter = std::max(enter, at);
        else
            leave = std::min(leave, at);
        return enter <= leave;
    };
    return clip(from.x - to.x, from.x - box.left) && clip(to.x - from.x, box.right - from.x) &&
           clip(from.y - to.y, from.y - box.top) && clip(to.y - from.y, box.bottom - from.y);
}

bool stretches_cross(const PlotPlace& a, const PlotPlace& b, const PlotPlace& c, const PlotPlace& d) {
    const auto side = [](const PlotPlace& p, const PlotPlace& q, const PlotPlace& r) {
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

// The label whose nearest point lies `distance_px` from the point, in the direction of `angle`.
PointLabel label_at(const PlotPlace& point, double width_px, double angle, double distance_px) {
    const double right = std::cos(angle);
    const double down = std::sin(angle);
    PointLabel label;
    label.leader_end = {point.x + right * distance_px, point.y + down * distance_px};
    const double left =
        right > 0.3 ? label.leader_end.x
                    : (right < -0.3 ? label.leader_end.x - width_px : label.leader_end.x - width_px / 2.0);
    label.anchor = right > 0.3 ? "start" : (right < -0.3 ? "end" : "middle");
    const double top = label.leader_end.y - label_height_px * (0.5 - 0.5 * down);
    label.box = {left, top, left + width_px, top + label_height_px};
    label.leader = distance_px >= leader_from_px;
    return label;
}

class Placing {
  public:
    Placing(std::span<const PlotPlace> points, const PlotBox& room, std::span<const PlotPlace> line)
        : points_(points), room_(room), line_(line) {}

    std::optional<PointLabel> place(std::size_t index, double width_px) {
        std::optional<PointLabel> best = best_place(index, width_px, true);
        if (!best) best = best_place(index, width_px, false);
        if (best) placed_.push_back({points_[index], *best});
        return best;
    }

  private:
    struct Placed {
        PlotPlace point;
        PointLabel label;
    };
    // `clear`: leaders cross neither each other nor labels.
    [[nodiscard]] std::optional<PointLabel> best_place(std::size_t index, double width_px, bool clear) const {
        constexpr std::array distances_px{9.0,  16.0, 24.0,  34.0,  46.0,  60.0,
                                          76.0, 94.0, 114.0, 138.0, 166.0, 200.0};
        constexpr int directions = 32;
        std::optional<PointLabel> best;
        double best_cost = 1e9;
        for (const double distance_px : distances_px) {
            for (int i = 0; i < directions; ++i) {
                const double angle = 2.0 * std::numbers::pi * i / directions;
                const PointLabel label = label_at(points_[index], width_px, angle, distance_px);
                if (!fits(index, label, clear)) continue;
                const double cost = distance_px + cost_of(index, label) + (i == 0 ? 0.0 : 2.0);
                if (cost >= best_cost) continue;
                best_cost = cost;
                best = label;
            }
        }
        return best;
    }
    [[nodiscard]] bool fits(std::size_t index, const PointLabel& label, bool clear) const {
        if (!inside(label.box, room_)) return false;
        for (const PlotPlace& point : points_)
            if (overlap(label.box, around(point, point_radius_px))) return false;
        for (const Placed& other : placed_) {
            if (overlap(label.box, other.label.box)) return false;
            if (!clear) continue;
            if (other.label.leader && crosses(label.box, other.point, other.label.leader_end)) return false;
            if (!label.leader) continue;
            if (crosses(other.label.box, points_[index], label.leader_end)) return false;
            if (other.label.leader &&
                stretches_cross(points_[index], label.leader_end, other.point, other.label.leader_end))
                return false;
        }
        return true;
    }
    // Lines through the label, and points that its leader runs over.
    [[nodiscard]] double cost_of(std::size_t index, const PointLabel& label) const {
        double cost = 0.0;
        for (std::size_t i = 0; i + 1 < line_.size(); ++i)
            if (crosses(label.box, line_[i], line_[i + 1])) cost += 40.0;
        if (!label.leader) return cost;
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (i != index && crosses(around(points_[i], point_radius_px), points_[index], label.leader_end))
                cost += 25.0;
        return cost;
    }

    std::span<const PlotPlace> points_;
    PlotBox room_;
    std::span<const PlotPlace> line_;
    std::vector<Placed> placed_;
};

}  // namespace

double text_width_px(const std::string& text, double size_px) {
    const auto characters = std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return 0.58 * size_px * static_cast<double>(characters) + 4.0;
}

std::vector<std::optional<PointLabel>> place_labels(std::span<const PlotPlace> points,
                                                    std::span<const double> widths_px, const PlotBox& room,
                                                    std::span<const PlotPlace> line) {
    Placing placing(points, room, line);
    std::vector<std::optional<PointLabel>> labels;
    for (std::size_t i = 0; i < points.size(); ++i) labels.push_back(placing.place(i, widths_px[i]));
    return labels;
}

}  // namespace oro
