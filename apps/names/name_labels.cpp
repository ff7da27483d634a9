#include "apps/names/name_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace oro {
namespace {

constexpr double smallest_px = 11.0;
constexpr double lines_in_picture = 72.0;
constexpr double capitals_share = 0.73;       // of the em
constexpr double below_base_share = 0.24;     // of the em: how far letters reach down
constexpr double above_capitals_share = 0.2;  // accents of capitals
constexpr double apart_share = 0.35;          // of the em: between the two lines
constexpr double gap_share = 0.9;             // of the em: the shortest leader
constexpr int steps_up = 24;
constexpr double cost_of_name_in_way = 2.5;  // in steps up, each as long as an em
constexpr int column_px = 64;

// Things of a picture by the columns that they stand in.
template <class Thing>
class ByColumn {
  public:
    explicit ByColumn(int width_px) : columns_(static_cast<std::size_t>(width_px / column_px + 1)) {}

    void add(double left, double right, const Thing& thing) {
        for (std::size_t i = column(left); i <= column(right); ++i) columns_[i].push_back(thing);
    }
    // Until one gives true; those that stand in several columns may be visited several times.
    template <class Visit>
    bool any(double left, double right, const Visit& visit) const {
        for (std::size_t i = column(left); i <= column(right); ++i) {
            for (const Thing& thing : columns_[i]) {
                if (visit(thing)) return true;
            }
        }
        return false;
    }

  private:
    [[nodiscard]] std::size_t column(double x) const {
        const double number = std::clamp(x / column_px, 0.0, static_cast<double>(columns_.size() - 1));
        return static_cast<std::size_t>(number);
    }
    std::vector<std::vector<Thing>> columns_;
};

// How large a label is, and where its lines stand in it.
struct Shape {
    double width_px;
    double height_px;
    double name_down_px;     // from the top to the middle of the name's capitals
    double heights_down_px;  // and of the line below
    double size_px;
    double halo_px;
};

Result<Shape> shape_of(const NameLabel& label, const NameWidth& width) {
    const double em = label.size_px, small = heights_share * em, halo = name_halo_share * em;
    ORO_TRY(const double name_px, width(label.point.name, em));
    ORO_TRY(const double heights_px, width(label.heights, small));
    const double name_base = halo + (above_capitals_share + capitals_share) * em,
                 heights_base = name_base + apart_share * em + capitals_share * small;
    return Shape{std::max(name_px, heights_px) + 2.0 * halo,
                 heights_base + below_base_share * small + halo,
                 name_base - 0.5 * capitals_share * em,
                 heights_base - 0.5 * capitals_share * small,
                 em,
                 halo};
}

// Puts a label so that its nearer border is `gap_px` above the point, or below it where that is negative;
// `lean` is where the point is along it: 0 its left end, 1 its right end.
void put(const Shape& shape, double gap_px, double lean, NameLabel& label) {
    const glm::dvec2 at = label.point.place_px;
    const double inset = std::min(0.5 * shape.width_px, shape.size_px);
    const double left = at.x - std::lerp(inset, shape.width_px - inset, lean);
    const double top = gap_px > 0.0 ? at.y - gap_px - shape.height_px : at.y - gap_px;
    label.box = {left, top, left + shape.width_px, top + shape.height_px};
    const double half = 0.5 + shape.halo_px;
    label.leader = gap_px > 0.0 ? Box{at.x - half, label.box.bottom, at.x + half, at.y}
                                : Box{at.x - half, at.y, at.x + half, label.box.top};
    const double middle = left + 0.5 * shape.width_px;
    label.name_px = {middle, top + shape.name_down_px};
    label.heights_px = {middle, top + shape.heights_down_px};
}

class Layout {
  public:
    Layout(const std::vector<SeenPoint>& points, int width_px, int height_px)
        : width_px_(width_px), height_px_(height_px), taken_(width_px), waiting_(width_px) {
        for (const SeenPoint& point : points)
            waiting_.add(point.place_px.x, point.place_px.x, point.place_px);
    }

    // True where there is room; the label is then where that is.
    bool find_room(const Shape& shape, NameLabel& label) {
        constexpr std::array leans{0.5, 0.0, 1.0};
        const double gap = gap_share * shape.size_px, step = shape.size_px;
        double least = std::numeric_limits<double>::infinity();
        NameLabel best;
        const auto offer = [&](double gap_px, double lean, double cost) {
            if (cost >= least) return;
            put(shape, gap_px, lean, label);
            if (!fits(label)) return;
            cost += cost_of_name_in_way * in_the_way_of(shape, label, least - cost);
            if (cost >= least) return;
            least = cost;
            best = label;
        };
        for (int up = 0; up < steps_up; ++up) {
            for (const double lean : leans) offer(gap + up * step, lean, up);
        }
        for (const double lean : leans) offer(-gap, lean, steps_up);
        if (!std::isfinite(least)) return false;
        label = std::move(best);
        taken_.add(label.box.left, label.box.right, label.box);
        taken_.add(label.leader.left, label.leader.right, label.leader);
        return true;
    }

  private:
    [[nodiscard]] bool fits(const NameLabel& label) const {
        const Box& box = label.box;
        if (box.left < 0.0 || box.top < 0.0 || box.right > width_px_ || box.bottom > height_px_) return false;
        const auto touched = [&](const Box& one) {
            return taken_.any(one.left, one.right, [&](const Box& other) { return one.touches(other); });
        };
        return !touched(box) && !touched(label.leader);
    }
    // How many points have no room for a name between them and this one, and so none at all right above them.
    [[nodiscard]] double in_the_way_of(const Shape& shape, const NameLabel& label, double enough) const {
        const double room_px = shape.height_px + gap_share * shape.size_px;
        double count = 0.0;
        waiting_.any(label.box.left, label.box.right, [&](glm::dvec2 place) {
            const bool above = place.x > label.box.left && place.x < label.box.right &&
                               place.y > label.box.top && place.y - room_px < label.box.bottom &&
                               place != label.point.place_px;
            count += above ? 1.0 : 0.0;
            return cost_of_name_in_way * count > enough;
        });
        return count;
    }

    int width_px_;
    int height_px_;
    ByColumn<Box> taken_;
    ByColumn<glm::dvec2> waiting_;
};

}  // namespace

double name_size_px(int picture_height_px) {
    return std::max(smallest_px, picture_height_px / lines_in_picture);
}

std::string heights_words(double H_m, double distance_m) {
    char text[80];
    if (distance_m < 1000.0)
        std::snprintf(text, sizeof text, "%ld m  %ld m", std::lround(H_m), std::lround(distance_m));
    else
        std::snprintf(text, sizeof text, "%ld m  %.*f km", std::lround(H_m), distance_m < 10e3 ? 1 : 0,
                      1e-3 * distance_m);
    return text;
}

Result<std::vector<NameLabel>> name_labels(const std::vector<SeenPoint>& points, int width_px, int height_px,
                                           const NameWidth& width) {
    std::vector<NameLabel> labels;
    Layout layout(points, width_px, height_px);
    for (const SeenPoint& point : points) {
        NameLabel label;
        label.point = point;
        label.heights = heights_words(point.H_m, point.distance_m);
        label.size_px = name_size_px(height_px);
        ORO_TRY(const Shape shape, shape_of(label, width));
        if (layout.find_room(shape, label)) labels.push_back(std::move(label));
    }
    return labels;
}

}  // namespace oro
