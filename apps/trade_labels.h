// Where the names of points go on a plot, so that they lie neither on each other nor on points.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oro {

struct PlotPlace {
    double x{}, y{};
};

struct PlotBox {
    double left{}, top{}, right{}, bottom{};
};

// About how wide text of this size is drawn, px; rather too much than too little.
double text_width_px(const std::string& text, double size_px);

struct PointLabel {
    PlotBox box;
    std::string anchor;  // start, middle or end: which part of the text lies nearest to its point
    bool leader{};       // so far from its point that a line must join them
    PlotPlace leader_end;
};

// One for each point, in their order; nothing where there is no room. Later points give way to earlier ones.
// `lines` is a polyline that labels should not cross but may.
std::vector<std::optional<PointLabel>> place_labels(std::span<const PlotPlace> points,
                                                    std::span<const double> widths_px, const PlotBox& room,
                                                    std::span<const PlotPlace> line);

}  // namespace oro
