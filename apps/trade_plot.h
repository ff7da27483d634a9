// The plots of a trade's page, as SVG inside HTML: no script, no style of their own but the page's classes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/trade_axis.h"
#include "apps/trade_labels.h"

namespace oro {

// Text size in all plots; they are never drawn smaller than 1:1.
inline constexpr double plot_text_px = 12.0;

// What a plot is: `id` is its data-plot, `label` what a screen reader says.
struct PlotHead {
    std::string id, label;
    int width_px{}, height_px{};
};

struct ScatterPoint {
    std::string setting, tip;
    double x{}, y{};
    bool on_front{};
};
struct Scatter {
    PlotHead head;
    std::string x_title, y_title;
    std::vector<ScatterPoint> points;
    bool join_front{};
};
// Both axes logarithmic. Every point is marked, and named where there is room.
std::string scatter_svg(const Scatter& scatter);

// Points in rows over one logarithmic axis.
struct RowPoint {
    std::string data;  // attributes that say whose it is: data-view="..."; escaped
    std::string tip;
    double value{};
    int mark{};  // which of the shapes and colours; 0 to row_marks - 1
    int lane{};  // of `lanes`: those of a row lie a little below each other
};
struct PlotRow {
    std::string name;
    std::vector<RowPoint> points;
    std::optional<double> limit;  // a line across the row
    std::string limit_tip;
    bool joined{};  // a line from the first point to the last
    bool alarm{};
};
struct RowPlot {
    PlotHead head;  // the height is that of the rows
    std::string x_title;
    std::vector<PlotRow> rows;
    int lanes{1};
};
inline constexpr int row_marks = 8;
// With more lanes than this, marks are pale, so that many on one place stand out.
inline constexpr int most_distinct_marks = row_marks - 2;
std::string rows_svg(RowPlot plot);
// One mark by itself, for legends.
std::string mark_svg(int mark);

// Shared by the two.
std::string svg_begin(const PlotHead& head, std::size_t points);
std::string svg_line(double x1, double y1, double x2, double y2, const std::string& style_class);
std::string svg_rectangle(const PlotBox& box, const std::string& style_class);
// anchor: start, middle, end. `text` is escaped here.
std::string svg_text(double x, double y, const std::string& style_class, const std::string& anchor,
                     const std::string& text);
std::string svg_number(double px);
// Bands, gridlines, ticks and title of a horizontal axis below `frame`.
std::string x_axis_svg(const LogAxis& axis, const PlotBox& frame, const std::string& title);

}  // namespace oro
