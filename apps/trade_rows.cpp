#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "apps/trade_parts.h"
#include "apps/trade_plot.h"

namespace oro {
namespace {

constexpr double row_px = 28.0;
constexpr double lane_px = 2.6;

// Bar, circle, triangle up, diamond, triangle down, plus, cross, square. The bar is seen behind a circle.
constexpr std::array<std::string_view, row_marks> shapes{
    "M-2,-9h4v18h-4z",
    "M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0z",
    "M0,-5L5,4H-5z",
    "M0,-5.5L5.5,0L0,5.5L-5.5,0z",
    "M0,5L5,-4H-5z",
    "M-1.5,-5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5z",
    "M-4.5,-3L-3,-4.5L0,-1.5L3,-4.5L4.5,-3L1.5,0L4.5,3L3,4.5L0,1.5L-3,4.5L-4.5,3L-1.5,0z",
    "M-4,-4h8v8h-8z"};

std::string shape_svg(int mark) {
    return "<path d=\"" + std::string(shapes.at(static_cast<std::size_t>(mark % row_marks))) + "\"/>";
}

bool is_missing(double value) {
    return !std::isfinite(value) || value < 0.0;
}

std::string row_svg(const PlotRow& row, const LogAxis& axis, const PlotBox& frame, double y, int lanes) {
    std::string svg = svg_line(frame.left, y, frame.right, y, "grid");
    svg += svg_text(frame.left - 10.0, y + 4.0, row.alarm ? "row alarm" : "row", "end", row.name);
    if (row.joined && row.points.size() > 1)
        svg += svg_line(axis.at(row.points.front().value), y, axis.at(row.points.back().value), y,
                        row.alarm ? "join alarm" : "join");
    for (const RowPoint& point : row.points) {
        const double down = (point.lane - (lanes - 1) / 2.0) * std::min(lane_px, (row_px - 10.0) / lanes);
        svg += "<g class=\"point mark" + std::to_string(point.mark % row_marks) +
               (is_missing(point.value) ? " missing" : "") + (lanes > most_distinct_marks ? " many" : "") +
               "\" " + point.data + " transform=\"translate(" + svg_number(axis.at(point.value)) + "," +
               svg_number(y + down) + ")\"><title>" + escaped(point.tip) + "</title>" +
               shape_svg(point.mark) + "</g>\n";
    }
    if (row.limit) {
        const std::string x = svg_number(axis.at(*row.limit));
        svg += "<g class=\"limit\"><title>" + escaped(row.limit_tip) + "</title><path d=\"M" + x + "," +
               svg_number(y - row_px / 2.0 + 2.0) + "v" + svg_number(row_px - 4.0) + "\"/></g>\n";
    }
    return svg;
}

}  // namespace

std::string mark_svg(int mark) {
    return "<svg class=\"key\" aria-hidden=\"true\" width=\"14\" height=\"14\" viewBox=\"-9 -9 18 18\"><g "
           "class=\"mark" +
           std::to_string(mark % row_marks) + "\">" + shape_svg(mark) + "</g></svg>";
}

std::string rows_svg(RowPlot plot) {
    double names_px = 40.0;
    std::vector<double> values;
    std::size_t count = 0;
    for (const PlotRow& row : plot.rows) {
        names_px = std::max(names_px, text_width_px(row.name, plot_text_px));
        for (const RowPoint& point : row.points) values.push_back(point.value);
        if (row.limit) values.push_back(*row.limit);
        count += row.points.size();
    }
    const double rows_px = row_px * static_cast<double>(std::max<std::size_t>(plot.rows.size(), 1));
    plot.head.height_px = static_cast<int>(rows_px + 8.0 + 46.0);
    const PlotBox frame{std::min(names_px + 14.0, plot.head.width_px / 2.0), 8.0, plot.head.width_px - 12.0,
                        8.0 + rows_px};
    const LogAxis axis(values, frame.left, frame.right);
    std::string svg = svg_begin(plot.head, count);
    svg += x_axis_svg(axis, frame, plot.x_title) + svg_rectangle(frame, "frame");
    for (std::size_t i = 0; i < plot.rows.size(); ++i)
        svg += row_svg(plot.rows[i], axis, frame, frame.top + row_px * (static_cast<double>(i) + 0.5),
                       plot.lanes);
    return svg + "</svg></div>\n";
}

}  // namespace oro
