#include <algorithm>
#include <cstdio>

#include "apps/trade/trade_parts.h"

namespace oro {
namespace {

constexpr std::size_t terminal_columns = 120;
constexpr std::size_t least_last_column = 16;
constexpr std::size_t most_name_columns = 32;

// Characters, not bytes; combining and double-width ones count as one.
std::size_t width_of(const std::string& text) {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

// At most `columns` characters, the last of them "~" where something is left out.
std::string cut(const std::string& text, std::size_t columns) {
    if (width_of(text) <= columns) return text;
    std::string kept;
    for (std::size_t i = 0, width = 0; i < text.size(); ++i) {
        if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U && ++width == columns) break;
        kept += text[i];
    }
    return kept + "~";
}

// Lines of at most `columns` characters, broken at spaces; a longer word has a line of its own.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
    std::vector<std::string> lines(1);
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        const std::string word = text.substr(from, to - from);
        if (!lines.back().empty() && width_of(lines.back()) + 1 + width_of(word) > columns)
            lines.emplace_back();
        if (!word.empty()) lines.back() += (lines.back().empty() ? "" : " ") + word;
        from = to + 1;
    }
    return lines;
}

// Characters before a number's point, and from there on.
struct Halves {
    std::size_t before{}, after{};
};
Halves halves_of(const std::string& number) {
    const std::size_t width = width_of(number), before = std::min(number.find('.'), width);
    return {before, width - before};
}

// A table whose first column is a name, the next are numbers, below each other by their points, and the last,
// if `text_last`, is text that may take several lines.
class Table {
  public:
    Table(std::vector<std::vector<std::string>> headers, bool text_last)
        : rows_(std::move(headers)), headers_(rows_.size()), text_last_(text_last) {}
    void add(std::vector<std::string> row) {
        row[0] = cut(row[0], most_name_columns);
        rows_.push_back(std::move(row));
    }
    [[nodiscard]] std::string text() const {
        const std::vector<Halves> columns = columns_of();
        const std::size_t before = width_before_last(columns);
        const std::size_t room = terminal_columns - std::min(before, terminal_columns);
        std::string text;
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            text += line(rows_[i], i < headers_, columns, std::max(room, least_last_column));
            if (i + 1 == headers_) text += std::string(std::min(rule(columns), terminal_columns), '-') + "\n";
        }
        return text;
    }

  private:
    [[nodiscard]] std::vector<Halves> columns_of() const {
        std::vector<Halves> columns(rows_[0].size());
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const Halves halves = is_number(r < headers_, i) ? halves_of(rows_[r][i]) : Halves{};
                columns[i].before = std::max(columns[i].before, halves.before);
                columns[i].after = std::max(columns[i].after, halves.after);
            }
        }
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const std::size_t width = width_of(rows_[r][i]);
                if (!is_number(r < headers_, i) && width > columns[i].before + columns[i].after)
                    columns[i].before = width - columns[i].after;
            }
        }
        return columns;
    }
    [[nodiscard]] bool is_number(bool header, std::size_t column) const {
        return !header && column > 0 && !(text_last_ && column + 1 == rows_[0].size());
    }
    [[nodiscard]] static std::size_t width_before_last(const std::vector<Halves>& columns) {
        std::size_t before = 0;
        for (std::size_t i = 0; i + 1 < columns.size(); ++i)
            before += columns[i].before + columns[i].after + 2;
        return before;
    }
    static std::size_t rule(const std::vector<Halves>& columns) {
        return width_before_last(columns) + columns.back().before + columns.back().after;
    }
    [[nodiscard]] std::string cell_text(const std::string& cell, bool header, std::size_t column,
                                        const Halves& width) const {
        const std::size_t all = width.before + width.after;
        if (column == 0) return cell + std::string(all - width_of(cell), ' ');
        if (!is_number(header, column)) return std::string(all - width_of(cell), ' ') + cell;
        const Halves halves = halves_of(cell);
        return std::string(width.before - halves.before, ' ') + cell +
               std::string(width.after - halves.after, ' ');
    }
    [[nodiscard]] std::string line(const std::vector<std::string>& row, bool header,
                                   const std::vector<Halves>& columns, std::size_t room) const {
        std::string text;
        const std::size_t numbers = text_last_ ? row.size() - 1 : row.size();
        for (std::size_t i = 0; i < numbers; ++i)
            text += (i > 0 ? "  " : "") + cell_text(row[i], header, i, columns[i]);
        if (text_last_) {
            const std::vector<std::string> lines = wrapped(row.back(), room);
            text += "  " + lines[0];
            for (std::size_t i = 1; i < lines.size(); ++i)
                text += "\n" + std::string(width_before_last(columns), ' ') + lines[i];
        }
        text.erase(text.find_last_not_of(' ') + 1);
        return text + "\n";
    }

    std::vector<std::vector<std::string>> rows_;
    std::size_t headers_;
    bool text_last_;
};

std::string limit_text(double limit_px) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", limit_px);
    return text;
}

std::string starred(const TradeSetting& setting) {
    return (setting.on_front ? "* " : "  ") + name_of(setting.key);
}

std::string costs_text(const TradeReport& report) {
    Table table({{"  setting", "first picture", "", "settled", "", "terrain"},
                 {"", "time, ms", "triangles", "time, ms", "triangles", "MB"}},
                false);
    for (const TradeSetting& setting : report.settings)
        table.add({starred(setting), coarse_figure(setting.first.gpu_ms), grouped(setting.first.triangles),
                   coarse_figure(setting.settled.gpu_ms), grouped(setting.settled.triangles),
                   coarse_figure(megabytes(setting.bytes))});
    return table.text() +
           "* unbeaten: no other setting is both as fast (first picture) and as close (ground, worst px), "
           "and "
           "better in one\n"
           "first picture: drawn by a program that has drawn nothing before; its making of shaders is not "
           "counted\n"
           "settled: the same once more, when it is known what the last picture saw, and light and shadow "
           "are "
           "there\n"
           "time: of the GPU, the median of the views; triangles: of all views; hidden ground is left out in "
           "both states,\n"
           "but where the Earth is a sphere or a plane\n"
           "terrain: what the GPU read of it\n";
}

std::string errors_text(const TradeReport& report) {
    Table table({{"  setting", "ground", "", "", "surface", "seen", "skyline", "limit"},
                 {"", "worst m", "worst px", "99 % px", "worst px", "worst px", "worst px", "px"}},
                false);
    for (const TradeSetting& setting : report.settings) {
        const bool measured = setting.displacement_pixels > 0;
        const auto ground = [&](double value, bool at_least = false) {
            return measured ? (at_least ? ">= " : "") + coarse_figure(value) : std::string("n/a");
        };
        table.add({starred(setting), ground(setting.displacement_m),
                   ground(setting.displacement_px, setting.displacement_px_at_least),
                   ground(setting.displacement_p99_px),
                   ground(setting.surface_px, setting.surface_px_at_least),
                   ground(setting.seen_px, setting.seen_px_at_least),
                   setting.skyline_columns > 0 ? coarse_figure(setting.skyline_px) : "n/a",
                   setting.limit_px ? limit_text(*setting.limit_px) : ""});
    }
    return table.text() +
           "ground: how far each pixel's ground is drawn from where it truly is, in metres and on the "
           "picture\n"
           "99 %: 99 of 100 points are off by no more than this\n"
           "surface: how far the drawn ground is from the true surface, wherever along it\n"
           "seen: how far away on the picture the truth has what is drawn\n"
           "skyline: how far the drawn skyline is from the true one\n"
           "limit: what none of them exceeds: --tau, and what drawing rounds off (0.05 px, more near "
           "ground)\n"
           ">=: at least this: nothing like it is seen within 32 px (seen), or its place is beside or behind "
           "the "
           "eye\n"
           "all of them are the same in both states\n";
}

std::string ratio_text(const std::optional<RatioRange>& ratio) {
    if (!ratio) return "";
    const std::string least = figure(ratio->least);
    const std::string most = figure(ratio->most);
    return least == most ? least : least + "-" + most;
}

std::string remark_of(const EffectWorst& effect) {
    const std::string how = remark_on(effect.measured_by);
    if (effect.broken_in.empty()) return how;
    const std::string where = effect.measured_views == 1
                                  ? "the one view"
                                  : std::to_string(effect.broken_in.size()) + " of " +
                                        std::to_string(effect.measured_views) + " views";
    return "MORE THAN PREDICTED in " + where + (how.empty() ? "" : "; ") + how;
}

std::string measured_text(const std::optional<double>& value) {
    return value ? coarse_figure(*value) : "n/a";
}

std::string predicted_text(const EffectWorst& effect, double value) {
    return is_predicted(effect.key) ? coarse_figure(value) : "-";
}

std::string effects_text(const TradeReport& report) {
    Table table({{"setting", "predicted", "measured", "ratio", "predicted", "measured", "ratio", "remark"},
                 {"(worst of the views)", "m", "m", "", "px", "px", "", ""}},
                true);
    for (const EffectWorst& effect : worst_effects(report))
        table.add({name_of(effect.key), predicted_text(effect, effect.predicted_m),
                   measured_text(effect.measured_m), ratio_text(effect.ratio_m),
                   predicted_text(effect, effect.predicted_px), measured_text(effect.measured_px),
                   ratio_text(effect.ratio_px), remark_of(effect)});
    return table.text() +
           "predicted: a bound, worked out before anything is drawn; orograph plan tells it for one view\n"
           "ratio: predicted / measured, least and most of the views; below 1 a bound does not hold\n";
}

}  // namespace

std::string trade_text(const TradeReport& report) {
    const std::string over = "over " + std::to_string(views_of(report).size()) +
                             (views_of(report).size() == 1 ? " view of " : " views of ") +
                             std::to_string(report.width_px) + " x " + std::to_string(report.height_px) +
                             " px";
    std::string text = "What each setting costs, " + over + "\n\n";
    text += report.settings.empty() ? "none\n" : costs_text(report);
    text += "\nHow close each setting is, " + over + "\n\n";
    text += report.settings.empty() ? "none\n" : errors_text(report);
    text += "\nWhat was predicted of each setting and of the data, and what was measured\n\n";
    text += report.effects.empty() ? "none\n" : effects_text(report);
    return text;
}

}  // namespace oro
