#include "apps/names/name_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace oro {
namespace {

constexpr double smallest_px = 11.0;
constexpr double lines_in_picture = 72.0;
constexpr double capitals_share = 0.73;       // of the em
constexpr double below_base_share = 0.24;     // of the em: how far letters reach down
constexpr double above_capitals_share = 0.2;  // accents of capitals
constexpr double apart_share = 0.35;          // of the em: between the two lines
constexpr double gap_share = 0.9;             // of the em: the shortest leader
constexpr int steps_up = 14;
constexpr int column_px = 64;

// All boxes that are taken, found by the columns of the picture that they stand in.
class Taken {
  public:
    explicit Taken(int width_px) : columns_(static_cast<std::size_t>(width_px / column_px + 1)) {}

    void add(const Box& box) {
        each_column(box, [&](std::vector<Box>& column) {
            column.push_back(box);
            return false;
        });
    }
    [[nodiscard]] bool touched_by(const Box& box) {
        return each_column(box, [&](const std::vector<Box>& column) {
            return std::ranges::any_of(column, [&](const Box& other) { return box.touches(other); });
        });
    }

  private:
    template <class Visit>
    bool each_column(const Box& box, const Visit& visit) {
        const int last = static_cast<int>(columns_.size()) - 1;
        const int from = std::clamp(static_cast<int>(box.left) / column_px, 0, last),
                  to = std::clamp(static_cast<int>(box.right) / column_px, 0, last);
        for (int i = from; i <= to; ++i) {
            if (visit(columns_[static_cast<std::size_t>(i)])) return true;
        }
        return false;
    }
    std::vector<std::vector<Box>> columns_;
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
    Layout(int width_px, int height_px) : width_px_(width_px), height_px_(height_px), taken_(width_px) {}

    // True where there is room; the label is then where that is.
    bool find_room(const Shape& shape, NameLabel& label) {
        constexpr std::array leans{0.5, 0.0, 1.0};
        const double gap = gap_share * shape.size_px, step = shape.size_px;
        for (int up = 0; up < steps_up; ++up) {
            for (const double lean : leans) {
                if (fits(shape, gap + up * step, lean, label)) return true;
            }
        }
        return std::ranges::any_of(leans, [&](double lean) { return fits(shape, -gap, lean, label); });
    }

  private:
    bool fits(const Shape& shape, double gap_px, double lean, NameLabel& label) {
        put(shape, gap_px, lean, label);
        const Box& box = label.box;
        if (box.left < 0.0 || box.top < 0.0 || box.right > width_px_ || box.bottom > height_px_) return false;
        if (taken_.touched_by(box) || taken_.touched_by(label.leader)) return false;
        taken_.add(box);
        taken_.add(label.leader);
        return true;
    }

    int width_px_;
    int height_px_;
    Taken taken_;
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
    Layout layout(width_px, height_px);
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
