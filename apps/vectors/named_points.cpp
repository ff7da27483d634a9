#include "apps/vectors/named_points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "geo/files/letter_case.h"

namespace oro {
namespace {

constexpr double most_metres = 20'000.0;
constexpr std::size_t longest_name = 200;  // bytes

// A name on one line, without spaces around it. It is drawn: what shapes its letters stays.
std::string tidied(std::string_view name) {
    std::string text = one_line(name, Joiners::kept_in_words);
    if (text.size() > longest_name) {
        std::size_t end = longest_name;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // whole letters
        text.resize(end);
    }
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

// Of OpenStreetMap's `natural`, and the words of other files.
bool says_summit(std::string_view kind) {
    const std::string words = lower_case(kind);
    return std::ranges::any_of(std::array{"peak", "volcano", "summit", "saddle", "ridge", "hill", "mountain",
                                          "gipfel", "sommet", "cima"},
                               [&](const char* word) { return words.find(word) != std::string::npos; });
}

bool may_be_summit(const VectorLayer& layer, const VectorShape& shape, const NamedPoint& point) {
    if (point.stated_H_m || point.prominence_m) return true;
    if (point.heights == HeightAbove::sea_level || point.heights == HeightAbove::ellipsoid) return true;
    return std::ranges::any_of(std::array{"natural", "class", "type", "sym"},
                               [&](const char* field) { return says_summit(layer.text(shape, field)); });
}

}  // namespace

std::optional<double> metres_from(std::string_view text) {
    std::string figures;
    std::size_t at = text.find_first_not_of(' ');
    for (; at < text.size(); ++at) {
        const char c = text[at];
        const bool is_figure = c >= '0' && c <= '9';
        if (is_figure || c == '.' || (c == '-' && figures.empty()))
            figures += c;
        else if (c != ',' || at + 3 >= text.size())  // of thousands
            break;
    }
    const std::string_view unit = at < text.size() ? text.substr(at) : "";
    if (!unit.empty() && unit != "m" && unit != " m") return std::nullopt;
    double metres = 0.0;
    const char* const end = figures.data() + figures.size();
    const auto read = std::from_chars(figures.data(), end, metres);
    if (figures.empty() || read.ec != std::errc() || read.ptr != end || !(std::abs(metres) <= most_metres))
        return std::nullopt;
    return metres;
}

bool has_named_point(const VectorFile& file, const std::string& name_field) {
    return std::ranges::any_of(file.layers, [&](const VectorLayer& layer) {
        return std::ranges::any_of(layer.shapes, [&](const VectorShape& shape) {
            return shape.kind == VectorKind::point && !tidied(layer.text(shape, name_field)).empty();
        });
    });
}

std::vector<NamedPoint> named_points(const VectorFile& file, const std::string& name_field) {
    std::vector<NamedPoint> points;
    for (const VectorLayer& layer : file.layers) {
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::point) continue;
            NamedPoint point;
            point.name = tidied(layer.text(shape, name_field));
            if (point.name.empty()) continue;
            const VectorPlace& place = shape.paths.front().front();
            point.lat_deg = place.lat_deg;
            point.lon_deg = place.lon_deg;
            if (std::isfinite(place.height_m)) {
                point.heights = shape.heights;
                point.height_m = place.height_m;
            }
            point.stated_H_m = metres_from(layer.text(shape, "ele"));
            point.prominence_m = metres_from(layer.text(shape, "prominence"));
            point.may_be_summit = may_be_summit(layer, shape, point);
            points.push_back(std::move(point));
        }
    }
    return points;
}

}  // namespace oro
