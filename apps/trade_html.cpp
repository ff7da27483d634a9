#include <algorithm>
#include <array>

#include "apps/trade_page.h"
#include "apps/trade_parts.h"

namespace oro {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

// A name and what it is; nothing for what is not known.
std::string fact(const std::string& name, const std::string& html, bool wide) {
    if (html.empty()) return {};
    return "<dt>" + name + "</dt><dd" + (wide ? " class=\"wide\">" : ">") + html + "</dd>\n";
}

std::string facts_html(const TradeReport& report) {
    const std::string size =
        std::to_string(report.width_px) + " \xC3\x97 " + std::to_string(report.height_px) + " px";
    return "<dl>\n" + fact("Region", escaped(report.region), true) +
           fact("Views",
                views_of(report).empty() ? "none"
                                         : counted(views_of(report).size(), "view", "views") + " of " + size,
                false) +
           fact("Settings", std::to_string(report.settings.size()), false) +
           fact("GPU", escaped(report.gpu), false) + fact("Driver", escaped(report.driver), false) +
           fact("Machine", escaped(report.machine), false) +
           fact("Pipeline", escaped(report.pipeline), false) +
           fact("Program", escaped(report.version), false) + fact("Made", escaped(report.time), false) +
           (report.command.empty() ? ""
                                   : fact("Command", "<code>" + escaped(report.command) + "</code>", true)) +
           "</dl>\n";
}

std::string front_finding(const TradeReport& report) {
    std::vector<TradeSetting> front;
    for (const TradeSetting& setting : report.settings)
        if (setting.on_front) front.push_back(setting);
    if (front.empty()) return {};
    std::sort(front.begin(), front.end(),
              [](const TradeSetting& a, const TradeSetting& b) { return a.gpu_ms < b.gpu_ms; });
    const auto said = [](const TradeSetting& setting) {
        return "<strong>" + escaped(setting.name) + "</strong> (" + figure(setting.gpu_ms) + " ms, " +
               figure(setting.interior_px) + " px)";
    };
    std::string html = "<li>On the Pareto front: " + std::to_string(front.size()) + " of " +
                       std::to_string(report.settings.size()) + " settings, ";
    if (front.size() == 1) return html + said(front.front()) + " alone.</li>\n";
    return html + "from the fastest, " + said(front.front()) + ", to the closest, " + said(front.back()) +
           ".</li>\n";
}

std::string promise_finding(const TradeReport& report) {
    std::size_t promised = 0;
    std::size_t broken = 0;
    for (const TradeShot& shot : report.shots) {
        const auto at =
            std::find_if(report.settings.begin(), report.settings.end(),
                         [&](const TradeSetting& setting) { return setting.name == shot.setting; });
        if (at == report.settings.end() || !at->promised_px || shot.interior_px.count == 0) continue;
        ++promised;
        if (!(shot.interior_px.largest <= *at->promised_px)) ++broken;
    }
    if (promised == 0) return {};
    if (broken == 0)
        return "<li>The error that a setting promises was kept in all " +
               counted(promised, "picture", "pictures") + " drawn with one that does.</li>\n";
    return "<li class=\"alarm\">The error that a setting promises was exceeded in " + std::to_string(broken) +
           " of " + counted(promised, "picture", "pictures") + " drawn with one that does.</li>\n";
}

std::string bounds_finding(const TradeReport& report) {
    std::size_t measured = 0;
    std::size_t broken = 0;
    std::size_t loose = 0;
    for (const TradeEffect& effect : report.effects) {
        if (!effect.measured_m && !effect.measured_px) continue;
        ++measured;
        if (bound_broken(effect)) ++broken;
        const auto ratio_m = bound_ratio(effect.predicted_m, effect.measured_m);
        const auto ratio_px = bound_ratio(effect.predicted_px, effect.measured_px);
        if (std::max(ratio_m.value_or(0.0), ratio_px.value_or(0.0)) > loose_ratio) ++loose;
    }
    if (measured == 0) return {};
    const std::string of_all = std::to_string(measured) + " bounds with something measured";
    std::string html =
        broken == 0 ? "<li>All " + of_all + " held; "
                    : "<li class=\"alarm\">" + std::to_string(broken) + " of " + of_all + " were exceeded; ";
    return html + std::to_string(loose) + (loose == 1 ? " is" : " are") +
           " more than 10 times the measured worst; for " + std::to_string(report.effects.size() - measured) +
           " nothing could be measured.</li>\n";
}

std::string findings_html(const TradeReport& report) {
    const std::string items = front_finding(report) + promise_finding(report) + bounds_finding(report);
    if (items.empty()) return "<p class=\"note\">Nothing was measured.</p>\n";
    return "<ul class=\"findings\">\n" + items + "</ul>\n";
}

// Source: PNG, 11.2.2: width and height are the 16th to 23rd byte. Nothing for what is no PNG.
std::string picture_size(const std::vector<std::uint8_t>& png) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    if (png.size() < 24 || !std::equal(signature.begin(), signature.end(), png.begin())) return {};
    const auto number = [&](std::size_t at) {
        return std::uint32_t{png[at]} << 24U | std::uint32_t{png[at + 1]} << 16U |
               std::uint32_t{png[at + 2]} << 8U | png[at + 3];
    };
    return " width=\"" + std::to_string(number(16)) + "\" height=\"" + std::to_string(number(20)) + "\"";
}

std::string pictures_html(const TradeReport& report) {
    if (report.pictures.empty()) return {};
    std::string html = "<section>\n<h2>Pictures</h2>\n<div class=\"pictures\">\n";
    for (const TradePicture& picture : report.pictures) {
        const std::string size = picture_size(picture.png);
        html += "<figure>";
        html += size.empty() ? "<p class=\"note\">no picture</p>"
                             : "<img alt=\"" + escaped(picture.title) + "\"" + size +
                                   " src=\"data:image/png;base64," + base64(picture.png) + "\">";
        html += "<figcaption><strong>" + escaped(picture.title) + "</strong>" + escaped(picture.caption) +
                "</figcaption></figure>\n";
    }
    return html + "</div>\n</section>\n";
}

std::string main_html(const TradeReport& report) {
    return "<main data-plots=\"" + std::to_string(page_plots) + "\" data-settings=\"" +
           std::to_string(report.settings.size()) + "\" data-shots=\"" + std::to_string(report.shots.size()) +
           "\" data-effects=\"" + std::to_string(worst_effects(report).size()) +
           "\">\n<h1>Speed and accuracy, measured</h1>\n"
           "<p class=\"lead\">Each setting draws the same views; every drawn point is compared with the "
           "full-resolution surface in double precision.</p>\n" +
           facts_html(report) + findings_html(report) + settings_plots_html(report) +
           settings_table_html(report) + effects_plot_html(report) + views_plots_html(report) +
           pictures_html(report) + "</main>\n";
}

}  // namespace

std::string trade_html(const TradeReport& report) {
    // The policy lets a browser take nothing from anywhere, whatever a name in the report may say.
    return std::string(
               "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
               "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
               "style-src 'unsafe-inline'\">\n"
               "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
               "<title>Orograph: speed and accuracy of ") +
           escaped(report.region.empty() ? "no region" : report.region) +
           "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style() +
           "</style>\n</head>\n<body>\n" + main_html(report) + "</body>\n</html>\n";
}

}  // namespace oro
