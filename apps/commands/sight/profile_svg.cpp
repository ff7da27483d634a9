// A profile as a drawing: axes with units, the ground as an area, its highest and lowest place.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "apps/commands/sight/profile_roofs.h"
#include "apps/commands/sight/profile_text.h"
#include "apps/report/figures.h"

namespace oro {
namespace {

constexpr double width_px = 1000.0, height_px = 420.0;
constexpr double left_px = 78.0, right_px = 976.0, top_px = 78.0, bottom_px = 358.0;

template <class... Values>
std::string printed(const char* format, Values... values) {
    std::array<char, 600> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

// A step of 1, 2 or 5 times a power of ten that cuts a length into `parts` parts or fewer.
double tick_step(double length, double parts) {
    const double least = length / parts, power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double times : {1.0, 2.0, 5.0}) {
        if (times * power >= least) return times * power;
    }
    return 10.0 * power;
}

std::string number_text(double value, double step) {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return printed("%.*f", decimals, value == 0.0 ? 0.0 : value);
}

struct Axis {
    double low, high;  // in metres
    double from_px, to_px;
    [[nodiscard]] double px(double value) const {
        return from_px + (value - low) / (high - low) * (to_px - from_px);
    }
    [[nodiscard]] double px_per_m() const { return std::abs(to_px - from_px) / (high - low); }
};

struct Axes {
    Axis x, y;
};

Axes axes_of(const Profile& profile) {
    Axes axes{{0.0, profile.length_m(), left_px, right_px}, {0.0, 1.0, bottom_px, top_px}};
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    const auto reach_to = [&](double H_m) {
        low = std::min(low, H_m);
        high = std::max(high, H_m);
    };
    for (const ProfilePoint& point : profile.points)
        if (point.has_ground) reach_to(point.H_m);
    for (const ProfileRoof& roof : profile.roofs)
        if (roof.is_there) reach_to(roof.H_m);
    if (low > high) return axes;
    // Level ground is drawn level, not its last millimetre.
    const double span = std::max(high - low, 10.0), middle = 0.5 * (low + high);
    axes.y.low = middle - 0.64 * span;
    axes.y.high = middle + 0.62 * span;
    return axes;
}

std::string text_at(double x, double y, const char* attributes, const std::string& words) {
    return printed("<text x=\"%.1f\" y=\"%.1f\" %s>%s</text>\n", x, y, attributes, words.c_str());
}

std::string axes_text(const Axes& axes) {
    std::string svg;
    const double y_step = tick_step(axes.y.high - axes.y.low, 7.0);
    for (double H_m = std::ceil(axes.y.low / y_step) * y_step; H_m <= axes.y.high; H_m += y_step) {
        const double y = axes.y.px(H_m);
        svg += printed("<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", left_px, y,
                       right_px, y);
        svg +=
            text_at(left_px - 8.0, y + 4.0, "class=\"tick\" text-anchor=\"end\"", number_text(H_m, y_step));
    }
    // Kilometres, or metres of a short line.
    const double unit_m = axes.x.high >= 2000.0 ? 1000.0 : 1.0;
    const double x_step = tick_step(axes.x.high / unit_m, 10.0);
    for (double along = 0.0; along * unit_m <= axes.x.high * (1.0 + 1e-12); along += x_step) {
        const double x = axes.x.px(along * unit_m);
        svg += printed("<line class=\"axis\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", x,
                       bottom_px, x, bottom_px + 5.0);
        svg +=
            text_at(x, bottom_px + 19.0, "class=\"tick\" text-anchor=\"middle\"", number_text(along, x_step));
    }
    svg +=
        printed("<path class=\"axis\" d=\"M%.1f %.1fV%.1fH%.1f\"/>\n", left_px, top_px, bottom_px, right_px);
    svg += text_at(0.5 * (left_px + right_px), bottom_px + 42.0, "class=\"name\" text-anchor=\"middle\"",
                   unit_m > 1.0 ? "distance along the line, km" : "distance along the line, m");
    const double y = 0.5 * (top_px + bottom_px);
    return svg +
           text_at(
               20.0, y,
               printed("class=\"name\" text-anchor=\"middle\" transform=\"rotate(-90 20 %.1f)\"", y).c_str(),
               "H: height above sea level, m");
}

// Points of a run on ground as places on the drawing; of those in half a pixel the first, the extremes and
// the last.
std::string run_path(const Profile& profile, const Axes& axes, std::size_t begin, std::size_t end) {
    std::string path;
    const auto add = [&](const ProfilePoint& point) {
        path +=
            printed("%s%.2f %.2f", path.empty() ? "" : "L", axes.x.px(point.along_m), axes.y.px(point.H_m));
    };
    constexpr double column_px = 0.5;
    for (std::size_t first = begin; first < end;) {
        const double column = std::floor(axes.x.px(profile.points[first].along_m) / column_px);
        std::size_t last = first, lowest = first, highest = first;
        for (std::size_t i = first; i < end; ++i) {
            if (std::floor(axes.x.px(profile.points[i].along_m) / column_px) != column) break;
            if (profile.points[i].H_m < profile.points[lowest].H_m) lowest = i;
            if (profile.points[i].H_m > profile.points[highest].H_m) highest = i;
            last = i;
        }
        std::array<std::size_t, 4> kept{first, std::min(lowest, highest), std::max(lowest, highest), last};
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (i == 0 || kept[i] != kept[i - 1]) add(profile.points[kept[i]]);
        }
        first = last + 1;
    }
    return path;
}

// What there is at a point; in a pit that is cut out of the terrain a mesh alone.
enum class Drawn { nothing, ground, mesh };
Drawn drawn_at(const Profile& profile, std::size_t i) {
    if (profile.points[i].has_ground) return Drawn::ground;
    return !profile.roofs.empty() && profile.roofs[i].is_there ? Drawn::mesh : Drawn::nothing;
}

std::string ground_text(const Profile& profile, const Axes& axes) {
    std::string svg;
    const std::vector<ProfilePoint>& points = profile.points;
    for (std::size_t begin = 0; begin < points.size();) {
        std::size_t end = begin;
        while (end < points.size() && drawn_at(profile, end) == drawn_at(profile, begin)) ++end;
        // From the last point before to the first one after it there is none.
        const double from_px = axes.x.px(points[begin].along_m);
        if (points[begin].has_ground && end - begin > 1) {
            const std::string path = run_path(profile, axes, begin, end);
            const double to_px = axes.x.px(points[end - 1].along_m);
            svg += printed("<path class=\"ground\" d=\"M%.2f %.1fL", from_px, bottom_px) + path +
                   printed("L%.2f %.1fZ\"/>\n", to_px, bottom_px);
            svg += "<path class=\"surface\" d=\"M" + path + "\"/>\n";
        } else if (drawn_at(profile, begin) == Drawn::nothing) {
            const double left = begin > 0 ? axes.x.px(points[begin - 1].along_m) : from_px;
            const double right = axes.x.px(points[std::min(end, points.size() - 1)].along_m);
            svg += printed("<rect class=\"void\" x=\"%.2f\" y=\"%.1f\" width=\"%.2f\" height=\"%.1f\"/>\n",
                           left, top_px, right - left, bottom_px - top_px);
            if (right - left > 60.0)
                svg += text_at(0.5 * (left + right), 0.5 * (top_px + bottom_px),
                               "class=\"name\" text-anchor=\"middle\"", "no data");
        }
        begin = end;
    }
    return svg;
}

// Meshes that stand over the ground: from it to their roofs. Where there is no ground they are what one
// stands on.
std::string roofs_text(const Profile& profile, const Axes& axes) {
    std::string svg;
    for (std::size_t begin = 0; begin < profile.roofs.size();) {
        std::size_t end = begin;
        while (end < profile.roofs.size() && profile.roofs[end].is_there == profile.roofs[begin].is_there)
            ++end;
        if (profile.roofs[begin].is_there && end - begin > 1) {
            std::string path;
            for (std::size_t i = begin; i < end; ++i)
                path += printed("%s%.2f %.2f", path.empty() ? "M" : "L", axes.x.px(profile.points[i].along_m),
                                axes.y.px(profile.roofs[i].H_m));
            for (std::size_t i = end; i-- > begin;) {
                const ProfilePoint& point = profile.points[i];
                path += printed("L%.2f %.2f", axes.x.px(point.along_m),
                                point.has_ground ? axes.y.px(point.H_m) : bottom_px);
            }
            svg += "<path class=\"top\" d=\"" + path + "Z\"/>\n";
        }
        begin = end;
    }
    return svg;
}

std::string mark_text(const Profile& profile, const Axes& axes, std::size_t number, bool above) {
    const ProfilePoint& point = profile.points[number];
    const double x = axes.x.px(point.along_m), y = axes.y.px(point.H_m);
    const char* anchor = x < left_px + 60.0 ? "start" : x > right_px - 60.0 ? "end" : "middle";
    return printed("<circle class=\"mark\" cx=\"%.2f\" cy=\"%.2f\" r=\"3\"/>\n", x, y) +
           text_at(x, above ? y - 9.0 : y + 18.0,
                   printed("class=\"label\" text-anchor=\"%s\"", anchor).c_str(),
                   printed("%.0f m", point.H_m));
}

constexpr const char* style =
    "<style>text{font-family:\"DejaVu Sans\",Verdana,Arial,sans-serif;fill:#222}.title{font-size:17px;"
    "font-weight:bold}.line{font-size:12px;fill:#444}.tick{font-size:12px}.name{font-size:13px}"
    ".label{font-size:12px;font-weight:bold;paint-order:stroke;stroke:#fff;stroke-width:3px}"
    ".grid{stroke:#d9d9d9;stroke-width:1}.axis{stroke:#222;stroke-width:1;fill:none}"
    ".ground{fill:#b9a582;fill-opacity:0.75}.surface{fill:none;stroke:#5a4526;stroke-width:1.4;"
    "stroke-linejoin:round}.void{fill:#e8e8e8}.mark{fill:#b22222;stroke:#fff;stroke-width:1}</style>\n";

}  // namespace

std::string profile_svg(const Profile& profile) {
    const Axes axes = axes_of(profile);
    const double length_m = profile.length_m();
    std::string svg = printed(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f "
        "%.0f\">\n",
        width_px, height_px, width_px, height_px);
    svg += style;
    if (!profile.roofs.empty())
        svg += "<style>.top{fill:#8a8f98;stroke:#3c4048;stroke-width:1.2;stroke-linejoin:round}</style>\n";
    svg += printed("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", width_px, height_px);
    svg += text_at(
        left_px, 28.0, "class=\"title\"",
        "Profile from " + ends_text(profile) +
            (length_m >= 2000.0 ? printed(", %.2f km", length_m / 1000.0) : printed(", %.1f m", length_m)));
    if (profile.sums.highest)
        svg +=
            text_at(left_px, 50.0, "class=\"line\"",
                    printed("ascent %.0f m, descent %.0f m (by rises and falls of %g m or more); heights are "
                            "drawn %s times as large as distances",
                            profile.sums.climbed_m, profile.sums.went_down_m, profile.sums.climb_threshold_m,
                            about(axes.y.px_per_m() / axes.x.px_per_m()).c_str()));
    svg += axes_text(axes) + roofs_text(profile, axes) + ground_text(profile, axes);
    svg += printed("<path class=\"axis\" d=\"M%.1f %.1fH%.1f\"/>\n", left_px, bottom_px, right_px);
    if (profile.sums.highest) {
        svg += mark_text(profile, axes, *profile.sums.highest, true);
        svg += mark_text(profile, axes, *profile.sums.lowest, false);
    }
    return svg + "</svg>\n";
}

}  // namespace oro
