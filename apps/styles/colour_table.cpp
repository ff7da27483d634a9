#include "apps/styles/colour_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/styles/colours.h"
#include "geo/files/foreign_text.h"

namespace oro {
namespace {

constexpr double largest_m = 1e9;
constexpr ColourCodes paper{244, 243, 238};  // where the table has no `nv`

struct NamedColour {
    std::string_view name;
    ColourCodes colour;
};
// As GDAL 3.6 has them; each is held against GDAL by a test.
constexpr std::array<NamedColour, 16> named_colours{{{"white", {255, 255, 255}},
                                                     {"black", {0, 0, 0}},
                                                     {"red", {255, 0, 0}},
                                                     {"green", {0, 255, 0}},
                                                     {"blue", {0, 0, 255}},
                                                     {"yellow", {255, 255, 0}},
                                                     {"magenta", {255, 0, 255}},
                                                     {"cyan", {0, 255, 255}},
                                                     {"aqua", {0, 191, 191}},
                                                     {"grey", {191, 191, 191}},
                                                     {"gray", {191, 191, 191}},
                                                     {"orange", {255, 127, 0}},
                                                     {"brown", {191, 127, 63}},
                                                     {"purple", {127, 0, 255}},
                                                     {"violet", {127, 0, 255}},
                                                     {"indigo", {0, 127, 255}}}};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return text;
}

std::vector<std::string> words_of(const std::string& line) {
    constexpr std::string_view between = " \t\r,:";
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = line.find_first_not_of(between, at)) != std::string::npos;) {
        const std::size_t end = std::min(line.find_first_of(between, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

// How colours go from one height to the next, as QGIS's tables say it; all others mix them.
enum class Classes {
    mixed,
    up_to,  // each colour holds from the height before, up to its own
    exact,  // at its own height alone
};

// What a line says: its colour, and where it holds.
struct Entry {
    enum class Kind { height, percentage, no_data };
    Kind kind{Kind::height};
    double value{};
    ColourCodes colour;
};
struct Table {
    std::vector<Entry> entries;
    Classes classes{Classes::mixed};
};

// A word of the file in quotes, as it can be shown: of foreign bytes and control characters marks alone, and
// no more than fits into a line.
std::string quoted(const std::string& word) {
    constexpr std::size_t longest = 60;
    if (word.size() <= longest) return "'" + foreign_text(word) + "'";
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(word[end]) & 0xc0U) == 0x80U) --end;  // between characters
    return "'" + foreign_text(word.substr(0, end)) + "...'";
}

// The reason, where a line cannot be read.
std::string read_colour(const std::vector<std::string>& words, ColourCodes& colour) {
    if (words.size() >= 4) {
        std::array<int, 3> codes{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto code = number_in(words[i + 1]);
            if (!code || *code < 0.0 || *code > 255.0)
                return quoted(words[i + 1]) + " is no number from 0 to 255";
            codes[i] = static_cast<int>(*code);
        }
        colour = {codes[0], codes[1], codes[2]};
        return "";
    }
    if (words.size() < 2) return "there is no colour";
    const std::string name = lower(words[1]);
    const auto* const found = std::ranges::find(named_colours, name, &NamedColour::name);
    if (found == named_colours.end()) return "no colour is called " + quoted(words[1]);
    colour = found->colour;
    return "";
}

std::string read_entry(const std::vector<std::string>& words, Entry& entry) {
    const std::string& first = words[0];
    if (lower(first) == "nv") {
        entry.kind = Entry::Kind::no_data;
    } else if (first.size() > 1 && first.ends_with('%')) {
        entry.kind = Entry::Kind::percentage;
        const auto value = number_in(std::string_view(first).substr(0, first.size() - 1));
        if (!value || *value < 0.0 || *value > 100.0)
            return quoted(first) + " is no percentage from 0 to 100";
        entry.value = *value;
    } else {
        // The class above all heights.
        const bool above_all = lower(first) == "inf" || lower(first) == "+inf";
        const auto value = above_all ? std::numeric_limits<double>::infinity() : number_in(first);
        if (!value || (!above_all && std::abs(*value) > largest_m))
            return quoted(first) + " is no height in metres";
        entry.value = *value;
    }
    return read_colour(words, entry.colour);
}

// The reason, where the words of QGIS's line are none.
std::string read_classes(const std::vector<std::string>& words, Classes& classes) {
    const std::string how = words.size() > 1 ? lower(words[1]) : "";
    static constexpr std::array<std::pair<std::string_view, Classes>, 3> known{
        {{"interpolated", Classes::mixed}, {"discrete", Classes::up_to}, {"exact", Classes::exact}}};
    for (const auto& [word, meant] : known) {
        if (how != word) continue;
        classes = meant;
        return "";
    }
    return "INTERPOLATION is INTERPOLATED, DISCRETE or EXACT, not " +
           quoted(words.size() > 1 ? words[1] : "");
}

Result<Table> read_table(const std::string& text, const std::string& file) {
    Table table;
    std::istringstream in(text);
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        const std::string where = file + ", line " + std::to_string(++number);
        if (line.starts_with('#') && line.find("COLOR_MODEL") != std::string::npos)
            return Error{ErrorKind::failed, where, "a palette of GMT; its heights must stand one on a line"};
        const std::vector<std::string> words = words_of(line);
        if (words.empty() || words[0].starts_with('#') || words[0].starts_with('/')) continue;
        Entry entry;
        const bool is_head = lower(words[0]) == "interpolation";
        const std::string reason = is_head ? read_classes(words, table.classes) : read_entry(words, entry);
        if (!reason.empty()) return Error{ErrorKind::failed, where, reason};
        if (!is_head) table.entries.push_back(entry);
    }
    return table;
}

using Stops = std::vector<std::pair<float, ColourCodes>>;

// A class ends so far above its height that what rounding adds to a height of its own still has its colour:
// heights are kept in steps of 2^-11 m.
float just_above(double H_m) {
    const auto at = static_cast<float>(H_m + 0x1p-11);
    return std::nextafter(at, std::numeric_limits<float>::infinity());
}

// The stops of a style, which mixes between two and steps where one stands twice; ascending. What no class
// holds is `outside`.
Stops stops_of(const std::vector<std::pair<double, ColourCodes>>& heights, Classes classes,
               ColourCodes outside) {
    Stops stops;
    const auto step = [&](float at, ColourCodes below, ColourCodes above) {
        stops.emplace_back(at, below);
        stops.emplace_back(at, above);
    };
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const auto& [H_m, colour] = heights[i];
        const bool is_last = i + 1 == heights.size();
        if (std::isinf(H_m)) {
            // QGIS mixes none of it in: an infinite height is infinitely far.
            if (stops.empty() && classes != Classes::exact) stops.emplace_back(0.0F, colour);
        } else if (classes == Classes::mixed) {
            stops.emplace_back(static_cast<float>(H_m), colour);
        } else if (classes == Classes::up_to) {
            step(just_above(H_m), colour, is_last ? outside : heights[i + 1].second);
        } else {
            step(-just_above(-H_m), outside, colour);
            step(just_above(H_m), colour, outside);
        }
    }
    return stops;
}

gpu::FrameStyle flat_map() {
    gpu::FrameStyle style{};
    style.tints_as_codes = 1;
    style.light = gpu::light_none;
    style.is_map = 1;
    style.sun_enu = {0.0F, 0.0F, 1.0F};
    style.relief = 1.0F;
    style.haze_distance_m = 1e9F;
    style.sky_scale_height_m = 8000.0F;
    style.no_data_colour = linear_light(paper);
    return style;
}

}  // namespace

Result<gpu::FrameStyle> style_of_colour_table(const std::string& text, const std::string& file,
                                              const std::function<HeightRange()>& range) {
    ORO_TRY(const Table table, read_table(text, file));
    gpu::FrameStyle style = flat_map();
    ColourCodes background = paper;
    std::optional<HeightRange> heights;
    std::vector<std::pair<double, ColourCodes>> coloured;
    for (const Entry& entry : table.entries) {
        double H_m = entry.value;
        if (entry.kind == Entry::Kind::no_data) {
            background = entry.colour;
            continue;
        }
        if (entry.kind == Entry::Kind::percentage) {
            if (!heights) heights = range();
            const double lowest_m = heights->lowest_m, highest_m = heights->highest_m;
            H_m = lowest_m + (highest_m - lowest_m) * entry.value / 100.0;
        }
        coloured.emplace_back(H_m, entry.colour);
    }
    style.no_data_colour = linear_light(background);
    std::ranges::stable_sort(coloured, {}, &std::pair<double, ColourCodes>::first);
    const Stops stops = stops_of(coloured, table.classes, background);
    if (stops.empty()) return Error{ErrorKind::failed, file, "no line holds a height and a colour"};
    if (stops.size() > gpu::tint_stops_max) {
        const std::size_t stops_each = stops.size() / coloured.size();
        return Error{ErrorKind::failed, file,
                     std::to_string(coloured.size()) + " heights; a style has room for " +
                         std::to_string(gpu::tint_stops_max / std::max<std::size_t>(1, stops_each))};
    }
    for (const auto& [H_m, colour] : stops) style.tints[style.tint_count++] = {H_m, unit_codes(colour)};
    return style;
}

}  // namespace oro
