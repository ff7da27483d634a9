#include "apps/legend/key_names.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace oro {
namespace {

// In ems of the legend.
constexpr double words_em = 0.9, square_em = 1.1, line_em = 1.6, title_line_em = 1.3;

}  // namespace

Result<std::vector<std::string>> wrapped(const TextFace& face, const std::vector<std::string>& lines,
                                         double size_px, double width_px) {
    std::vector<std::string> all;
    for (const std::string& line : lines) {
        std::istringstream words(line);
        std::string now;
        for (std::string word; words >> word;) {
            const std::string longer = now.empty() ? word : now + " " + word;
            ORO_TRY(const double length_px, face.width_px(longer, size_px));
            if (length_px > width_px && !now.empty()) {
                all.push_back(now);
                now = word;
            } else {
                now = longer;
            }
        }
        all.push_back(now);
    }
    return all;
}

Result<PlacedNames> place_names(const TextFace& face, const ColourKey& key, glm::dvec2 at_px, double right_px,
                                double em_px) {
    PlacedNames placed;
    placed.at_px = at_px;
    placed.em_px = em_px;
    ORO_TRY(placed.title, wrapped(face, {key.title}, words_em * em_px, right_px - at_px.x));
    for (const std::string& line : placed.title) {
        ORO_TRY(const double wide_px, face.width_px(line, words_em * em_px));
        placed.right_px = std::max(placed.right_px, at_px.x + wide_px);
    }
    const auto more_lines = static_cast<double>(placed.title.size() - 1);
    double x = at_px.x, top = at_px.y + 1.55 * em_px + more_lines * title_line_em * em_px;
    for (const ColourKey::Named& named : key.names) {
        ORO_TRY(const double wide_px, face.width_px(named.name, words_em * em_px));
        if (x > at_px.x && x + 1.4 * em_px + wide_px > right_px) {
            x = at_px.x;
            top += line_em * em_px;
        }
        placed.squares_px.emplace_back(x, top);
        placed.right_px = std::max(placed.right_px, x + 1.4 * em_px + wide_px);
        x += 2.2 * em_px + wide_px;
    }
    placed.bottom_px = top + square_em * em_px;
    return placed;
}

Result<void> draw_names(Strip& strip, const TextFace& face, const ColourKey& key, const PlacedNames& placed) {
    const double em = placed.em_px, side = square_em * em;
    double base = placed.at_px.y + 0.85 * em;
    for (const std::string& line : placed.title) {
        ORO_CHECK(strip.write(face, line, {placed.at_px.x, base}, words_em * em, legend_quiet));
        base += title_line_em * em;
    }
    for (std::size_t i = 0; i < key.names.size(); ++i) {
        const glm::dvec2 at = placed.squares_px[i];
        // Light colours end at a frame, not in the paper.
        strip.fill(at - 1.0, glm::dvec2(side + 2.0), legend_quiet);
        strip.fill(at, glm::dvec2(side), key.names[i].colour);
        ORO_CHECK(strip.write(face, key.names[i].name, {at.x + 1.4 * em, at.y + 0.85 * em}, words_em * em,
                              legend_ink));
    }
    return {};
}

}  // namespace oro
