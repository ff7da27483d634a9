#include <algorithm>

#include "apps/trade_page.h"
#include "apps/trade_parts.h"

namespace oro {
namespace {

// "4.2e-5" as 4.2 x 10 to the -5th.
std::string figure_html(double value) {
    const std::string text = figure(value);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    std::string power = text.substr(e + 1);
    if (power[0] == '-') power.replace(0, 1, "\xE2\x88\x92");
    return text.substr(0, e) +
           "\xC2\xB7"
           "10<sup>" +
           power + "</sup>";
}

// `--earth flat --geoid none`, each option unbroken.
std::string options_html(const std::string& options) {
    std::string html;
    for (std::size_t from = 0; from < options.size();) {
        const std::size_t to = std::min(options.find(" --", from + 1), options.size());
        html += (from > 0 ? " <code>" : "<code>") + escaped(options.substr(from, to - from)) + "</code>";
        from = to + 1;
    }
    return html;
}

std::string cell(const std::string& html) {
    return "<td>" + html + "</td>";
}
std::string text_cell(const std::string& text) {
    return "<td class=\"text\">" + escaped(text) + "</td>";
}
std::string number_cell(const std::optional<double>& value) {
    return value ? cell(figure_html(*value)) : "<td class=\"none\">n/a</td>";
}
std::string measured_cell(bool measured, double value) {
    return number_cell(measured ? std::optional(value) : std::nullopt);
}

std::string table_begin(const std::string& caption, const std::string& head) {
    return "<div class=\"table\"><table>\n<caption>" + caption + "</caption>\n<thead>\n" + head +
           "</thead>\n<tbody>\n";
}
constexpr const char* table_end = "</tbody>\n</table></div>\n";

std::string ratio_html(const std::optional<RatioRange>& ratio) {
    if (!ratio) return "<td class=\"none\">n/a</td>";
    const std::string least = figure_html(ratio->least);
    const std::string most = figure_html(ratio->most);
    const char* style = ratio->least < 1.0 ? "<td class=\"alarm\">"
                                           : (ratio->most > loose_ratio ? "<td class=\"loose\">" : "<td>");
    return style + (least == most ? least : least + "\xE2\x80\x93" + most) + "</td>";
}

std::optional<RatioRange> as_range(const std::optional<double>& ratio) {
    if (!ratio) return std::nullopt;
    return RatioRange{*ratio, *ratio};
}

constexpr const char* effects_head =
    "<th colspan=\"3\" scope=\"colgroup\">metres</th><th colspan=\"3\" scope=\"colgroup\">pixels</th>"
    "<th rowspan=\"2\" scope=\"col\" class=\"text\">Remark</th></tr>\n"
    "<tr><th scope=\"col\">predicted</th><th scope=\"col\">measured</th><th scope=\"col\">ratio</th>"
    "<th scope=\"col\">predicted</th><th scope=\"col\">measured</th><th scope=\"col\">ratio</th></tr>\n";

std::string all_effects_html(const TradeReport& report) {
    std::string html = "<details>\n<summary>Each effect in each view (" +
                       std::to_string(report.effects.size()) + " rows)</summary>\n" +
                       table_begin("Each effect in each view",
                                   std::string("<tr><th rowspan=\"2\" scope=\"col\" class=\"text\">View</th>"
                                               "<th rowspan=\"2\" scope=\"col\" class=\"text\">Effect</th>") +
                                       effects_head);
    for (const TradeEffect& effect : report.effects)
        html += (bound_broken(effect) ? "<tr class=\"alarm\">" : "<tr>") + text_cell(effect.view) +
                text_cell(effect.effect) + number_cell(effect.predicted_m) + number_cell(effect.measured_m) +
                ratio_html(as_range(bound_ratio(effect.predicted_m, effect.measured_m))) +
                number_cell(effect.predicted_px) + number_cell(effect.measured_px) +
                ratio_html(as_range(bound_ratio(effect.predicted_px, effect.measured_px))) +
                text_cell(effect.remark) + "</tr>\n";
    return html + table_end + "</details>\n";
}

std::string shot_row(const TradeShot& shot) {
    const ErrorSummary& m = shot.interior_m;
    const ErrorSummary& px = shot.interior_px;
    const ErrorSummary& skyline = shot.skyline_px;
    std::string html = "<tr>" + text_cell(shot.view) + text_cell(shot.setting) +
                       cell(figure_html(shot.gpu_ms)) + cell(grouped(shot.triangles)) +
                       cell(figure_html(megabytes(shot.bytes)));
    for (const double value : {m.largest, m.p99, m.mean}) html += measured_cell(m.count > 0, value);
    for (const double value : {px.largest, px.p9999, px.p99, px.mean})
        html += measured_cell(px.count > 0, value);
    html += cell(grouped(px.count));
    for (const double value : {skyline.largest, skyline.p99, skyline.mean})
        html += measured_cell(skyline.count > 0, value);
    return html + cell(grouped(skyline.count)) + cell(grouped(shot.skyline_in_one_only)) + "</tr>\n";
}

}  // namespace

std::string settings_table_html(const TradeReport& report) {
    std::string html = "<section>\n<h2>Settings</h2>\n";
    html += table_begin(
        "Over all views: median time, sums, worst errors, mean of means. \xE2\x97\x8F is on the Pareto "
        "front.",
        "<tr><th rowspan=\"2\" scope=\"col\"><abbr title=\"on the Pareto front\">\xE2\x97\x8F</abbr></th>"
        "<th rowspan=\"2\" scope=\"col\" class=\"text\">Setting</th><th rowspan=\"2\" "
        "scope=\"col\">Time<br>ms</th>"
        "<th rowspan=\"2\" scope=\"col\">Triangles</th><th rowspan=\"2\" scope=\"col\">Read<br>MB</th>"
        "<th colspan=\"5\" scope=\"colgroup\">Interior error</th>"
        "<th rowspan=\"2\" scope=\"col\">Skyline<br>worst px</th>"
        "<th rowspan=\"2\" scope=\"col\" class=\"text\">Options</th></tr>\n"
        "<tr><th scope=\"col\">worst m</th><th scope=\"col\">worst px</th><th scope=\"col\">promised px</th>"
        "<th scope=\"col\">99 % px</th><th scope=\"col\">mean px</th></tr>\n");
    for (const TradeSetting& setting : report.settings) {
        const bool measured = setting.interior_pixels > 0;
        const bool broken = measured && setting.promised_px && !(setting.interior_px <= *setting.promised_px);
        html += (setting.on_front ? "<tr class=\"front\">" : "<tr>") +
                cell(setting.on_front ? "\xE2\x97\x8F" : "") + "<th scope=\"row\" class=\"text\">" +
                escaped(setting.name) + "</th>" + cell(figure_html(setting.gpu_ms)) +
                cell(grouped(setting.triangles)) + cell(figure_html(megabytes(setting.bytes))) +
                measured_cell(measured, setting.interior_m) +
                (broken ? "<td class=\"alarm\">" + figure_html(setting.interior_px) + "</td>"
                        : measured_cell(measured, setting.interior_px)) +
                (setting.promised_px ? number_cell(setting.promised_px) : cell("")) +
                measured_cell(measured, setting.interior_p99_px) +
                measured_cell(measured, setting.interior_mean_px) +
                measured_cell(setting.skyline_columns > 0, setting.skyline_px) + "<td class=\"text\">" +
                options_html(setting.options) + "</td></tr>\n";
    }
    return html + table_end + "</section>\n";
}

std::string effects_table_html(const TradeReport& report) {
    std::string html = table_begin(
        "Worst over the views. Ratio: predicted / measured, least and most of the views; below 1 a bound is "
        "broken, "
        "above 10 it says little.",
        std::string("<tr><th rowspan=\"2\" scope=\"col\" class=\"text\">Effect</th>") + effects_head);
    for (const EffectWorst& effect : worst_effects(report)) {
        std::string remark = escaped(effect.remark);
        if (!effect.broken_in.empty()) {
            std::string broken = "<strong>More than predicted in " + std::to_string(effect.broken_in.size()) +
                                 " of " + std::to_string(effect.measured_views) + " views.</strong> ";
            remark = broken + remark;
        }
        html += std::string(effect.broken_in.empty() ? "<tr>" : "<tr class=\"alarm\">") +
                "<th scope=\"row\" class=\"text\">" + escaped(effect.effect) + "</th>" +
                number_cell(effect.predicted_m) + number_cell(effect.measured_m) +
                ratio_html(effect.ratio_m) + number_cell(effect.predicted_px) +
                number_cell(effect.measured_px) + ratio_html(effect.ratio_px) + "<td class=\"text\">" +
                remark + "</td></tr>\n";
    }
    return html + table_end + all_effects_html(report);
}

std::string shots_table_html(const TradeReport& report) {
    std::string html =
        "<details>\n<summary>Each view with each setting (" + std::to_string(report.shots.size()) +
        " rows)</summary>\n" +
        table_begin(
            "Each view with each setting",
            "<tr><th rowspan=\"2\" scope=\"col\" class=\"text\">View</th>"
            "<th rowspan=\"2\" scope=\"col\" class=\"text\">Setting</th>"
            "<th rowspan=\"2\" scope=\"col\">Time<br>ms</th><th rowspan=\"2\" scope=\"col\">Triangles</th>"
            "<th rowspan=\"2\" scope=\"col\">Read<br>MB</th>"
            "<th colspan=\"3\" scope=\"colgroup\">Interior, m</th>"
            "<th colspan=\"5\" scope=\"colgroup\">Interior, px</th>"
            "<th colspan=\"5\" scope=\"colgroup\">Skyline, px</th></tr>\n"
            "<tr><th scope=\"col\">worst</th><th scope=\"col\">99 %</th><th scope=\"col\">mean</th>"
            "<th scope=\"col\">worst</th><th scope=\"col\">99.99 %</th><th scope=\"col\">99 %</th>"
            "<th scope=\"col\">mean</th><th scope=\"col\">pixels</th>"
            "<th scope=\"col\">worst</th><th scope=\"col\">99 %</th><th scope=\"col\">mean</th>"
            "<th scope=\"col\">columns</th><th scope=\"col\">in one only</th></tr>\n");
    for (const TradeShot& shot : report.shots) html += shot_row(shot);
    return html + table_end + "</details>\n";
}

}  // namespace oro
