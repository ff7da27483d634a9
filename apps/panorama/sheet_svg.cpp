// Sheets as SVG 1.1.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "apps/panorama/sheet.h"
#include "apps/report/base64.h"
#include "apps/report/xml_escape.h"
#include "geo/pictures/png_bytes.h"

namespace oro {
namespace {

constexpr double capital_share = 0.729;  // of the em, as apps/text has it

template <class... Values>
std::string printed(const char* format, Values... values) {
    std::array<char, 400> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string hex(const SheetColour& colour) {
    return printed("#%02x%02x%02x", colour[0], colour[1], colour[2]);
}

const char* word_of(SheetText::Anchor anchor) {
    switch (anchor) {
        case SheetText::Anchor::begin:
            return "start";
        case SheetText::Anchor::middle:
            return "middle";
        case SheetText::Anchor::end:
            break;
    }
    return "end";
}

std::string text_element(const SheetText& text) {
    // From half the height of capitals down to the base line.
    const double radians = text.angle_deg * std::numbers::pi / 180.0,
                 down_px = 0.5 * capital_share * text.size_px;
    const double x = text.at_px.x - down_px * std::sin(radians),
                 y = text.at_px.y + down_px * std::cos(radians);
    std::string xml = printed(
        "<text class=\"%s\" x=\"%.3f\" y=\"%.3f\" font-size=\"%.3f\" text-anchor=\"%s\" "
        "fill=\"%s\"",
        text.kind.c_str(), x, y, text.size_px, word_of(text.anchor), hex(text.ink).c_str());
    if (text.angle_deg != 0.0) xml += printed(" transform=\"rotate(%.3f %.3f %.3f)\"", text.angle_deg, x, y);
    if (text.halo)
        xml +=
            printed(" stroke=\"%s\" stroke-width=\"%.3f\" stroke-linejoin=\"round\" paint-order=\"stroke\"",
                    hex(*text.halo).c_str(), 2.0 * sheet_halo_share * text.size_px);
    return xml + ">" + xml_escaped(text.text) + "</text>\n";
}

std::string line_element(const SheetLine& line) {
    return printed(
        "<line x1=\"%.3f\" y1=\"%.3f\" x2=\"%.3f\" y2=\"%.3f\" stroke=\"%s\" stroke-width=\"%.3f\"/>\n",
        line.from_px.x, line.from_px.y, line.to_px.x, line.to_px.y, hex(line.colour).c_str(), line.width_px);
}

}  // namespace

Result<std::string> sheet_svg(const Sheet& sheet, std::span<const std::uint8_t> scene_rgb,
                              const std::string& title, const std::string& description) {
    ORO_TRY(const std::vector<std::uint8_t> png, png_bytes(scene_rgb, sheet.width_px, sheet.scene_rows_px));
    std::string svg = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    svg += printed(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "xml:space=\"preserve\" "
        "width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
        "font-family=\"'DejaVu Sans', Verdana, sans-serif\">\n",
        sheet.width_px, sheet.height_px, sheet.width_px, sheet.height_px);
    svg += "<title>" + xml_escaped(title) + "</title>\n<desc>" + xml_escaped(description) + "</desc>\n";
    svg += printed("<rect width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", sheet.width_px, sheet.height_px,
                   hex(sheet.paper).c_str());
    svg += printed("<image x=\"0\" y=\"%d\" width=\"%d\" height=\"%d\" xlink:href=\"data:image/png;base64,",
                   sheet.scene_top_px, sheet.width_px, sheet.scene_rows_px);
    svg += base64(png);
    svg += "\"/>\n";
    for (const SheetLine& line : sheet.lines) svg += line_element(line);
    for (const SheetText& text : sheet.texts) svg += text_element(text);
    return svg + "</svg>\n";
}

}  // namespace oro
