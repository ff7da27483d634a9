#include "apps/trade_plot.h"

#include <algorithm>

#include "apps/trade_parts.h"

namespace oro {
namespace {

std::string y_axis_svg(const LogAxis& axis, const PlotBox& frame, const std::string& title) {
    std::string svg;
    for (const LogAxis::Band& band : axis.bands()) {
        svg += svg_rectangle({frame.left, band.to_px, frame.right, band.from_px}, "band");
        svg += svg_text(frame.left - 8.0, (band.from_px + band.to_px) / 2.0 + 4.0, "tick", "end", band.label);
    }
    for (const AxisTick& tick : axis.ticks()) {
        svg += svg_line(frame.left, tick.px, frame.right, tick.px, "grid");
        svg += svg_text(frame.left - 8.0, tick.px + 4.0, "tick", "end", tick.label);
    }
    const std::string middle = svg_number((frame.top + frame.bottom) / 2.0);
    return svg + "<text class=\"title\" text-anchor=\"middle\" transform=\"translate(14," + middle +
           ") rotate(-90)\">" + escaped(title) + "</text>\n";
}

std::string point_svg(const ScatterPoint& point, const PlotPlace& place) {
    return "<g class=\"point " + std::string(point.on_front ? "front" : "other") + "\" data-setting=\"" +
           escaped(point.setting) + "\" transform=\"translate(" + svg_number(place.x) + "," +
           svg_number(place.y) + ")\"><title>" + escaped(point.tip) + "</title><circle r=\"" +
           (point.on_front ? "5.5" : "4.5") + "\"/></g>\n";
}

std::string label_svg(const ScatterPoint& point, const PlotPlace& place, const PointLabel& label) {
    std::string svg;
    if (label.leader) svg += svg_line(place.x, place.y, label.leader_end.x, label.leader_end.y, "leader");
    const double x = label.anchor == "start" ? label.box.left
                     : label.anchor == "end" ? label.box.right
                                             : (label.box.left + label.box.right) / 2.0;
    return svg + svg_text(x, label.box.bottom - 3.5, point.on_front ? "name front" : "name", label.anchor,
                          point.setting);
}

// The front's settings first: they are named first, and drawn last.
std::vector<ScatterPoint> front_first(std::vector<ScatterPoint> points) {
    std::stable_partition(points.begin(), points.end(), [](const ScatterPoint& p) { return p.on_front; });
    return points;
}

}  // namespace

std::string svg_number(double px) {
    // Hundredths are enough on a screen, and keep the page small.
    const auto hundredths = static_cast<long long>(px * 100.0 + (px < 0.0 ? -0.5 : 0.5));
    return all_digits(static_cast<double>(hundredths) / 100.0);
}

std::string svg_begin(const PlotHead& head, std::size_t points) {
    const std::string width = std::to_string(head.width_px);
    const std::string height = std::to_string(head.height_px);
    return "<div class=\"plot\"><svg role=\"img\" aria-label=\"" + escaped(head.label) + "\" data-plot=\"" +
           escaped(head.id) + "\" data-points=\"" + std::to_string(points) + "\" viewBox=\"0 0 " + width +
           " " + height + "\" width=\"" + width + "\" height=\"" + height + "\">\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, const std::string& style_class) {
    return "<line class=\"" + style_class + "\" x1=\"" + svg_number(x1) + "\" y1=\"" + svg_number(y1) +
           "\" x2=\"" + svg_number(x2) + "\" y2=\"" + svg_number(y2) + "\"/>\n";
}

std::string svg_rectangle(const PlotBox& box, const std::string& style_class) {
    return "<rect class=\"" + style_class + "\" x=\"" + svg_number(box.left) + "\" y=\"" +
           svg_number(box.top) + "\" width=\"" + svg_number(box.right - box.left) + "\" height=\"" +
           svg_number(box.bottom - box.top) + "\"/>\n";
}

std::string svg_text(double x, double y, const std::string& style_class, const std::string& anchor,
                     const std::string& text) {
    return "<text class=\"" + style_class + "\" text-anchor=\"" + anchor + "\" x=\"" + svg_number(x) +
           "\" y=\"" + svg_number(y) + "\">" + escaped(text) + "</text>\n";
}

std::string x_axis_svg(const LogAxis& axis, const PlotBox& frame, const std::string& title) {
    std::string svg;
    for (const LogAxis::Band& band : axis.bands()) {
        svg += svg_rectangle({band.from_px, frame.top, band.to_px, frame.bottom}, "band");
        svg += svg_text((band.from_px + band.to_px) / 2.0, frame.bottom + 18.0, "tick", "middle", band.label);
    }
    for (const AxisTick& tick : axis.ticks()) {
        svg += svg_line(tick.px, frame.top, tick.px, frame.bottom, "grid");
        svg += svg_text(tick.px, frame.bottom + 18.0, "tick", "middle", tick.label);
    }
    return svg + svg_text((frame.left + frame.right) / 2.0, frame.bottom + 38.0, "title", "middle", title);
}

std::string scatter_svg(const Scatter& scatter) {
    const PlotBox frame{62.0, 8.0, scatter.head.width_px - 12.0, scatter.head.height_px - 46.0};
    const std::vector<ScatterPoint> points = front_first(scatter.points);
    std::vector<double> xs, ys, widths_px;
    for (const ScatterPoint& point : points) {
        xs.push_back(point.x);
        ys.push_back(point.y);
        widths_px.push_back(text_width_px(point.setting, plot_text_px));
    }
    const LogAxis x_axis(xs, frame.left, frame.right);
    const LogAxis y_axis(ys, frame.bottom, frame.top);
    std::vector<PlotPlace> places, front;
    for (const ScatterPoint& point : points) {
        places.push_back({x_axis.at(point.x), y_axis.at(point.y)});
        if (point.on_front && scatter.join_front) front.push_back(places.back());
    }
    std::sort(front.begin(), front.end(), [](const PlotPlace& a, const PlotPlace& b) { return a.x < b.x; });

    std::string svg = svg_begin(scatter.head, points.size());
    svg += x_axis_svg(x_axis, frame, scatter.x_title) + y_axis_svg(y_axis, frame, scatter.y_title);
    svg += svg_rectangle(frame, "frame");
    if (front.size() > 1) {
        svg += "<polyline class=\"front\" points=\"";
        for (const PlotPlace& place : front) svg += svg_number(place.x) + "," + svg_number(place.y) + " ";
        svg += "\"/>\n";
    }
    const auto labels = place_labels(places, widths_px, frame, front);
    for (std::size_t i = 0; i < points.size(); ++i)
        if (labels[i]) svg += label_svg(points[i], places[i], *labels[i]);
    for (std::size_t i = points.size(); i-- > 0;) svg += point_svg(points[i], places[i]);
    svg += "</svg></div>\n";
    const auto nameless = std::count(labels.begin(), labels.end(), std::nullopt);
    if (nameless > 0)
        svg += "<p class=\"note\">" + std::to_string(nameless) +
               " points have no room for their names; they say them when pointed at.</p>\n";
    return svg;
}

}  // namespace oro
