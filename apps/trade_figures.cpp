#include <algorithm>
#include <limits>

#include "apps/trade_page.h"
#include "apps/trade_parts.h"
#include "apps/trade_plot.h"

namespace oro {
namespace {

constexpr int full_width_px = 1040;
constexpr int half_width_px = 512;
constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::string attribute(const std::string& name, const std::string& value) {
    return name + "=\"" + escaped(value) + "\"";
}

double interior_or_missing(const TradeSetting& setting) {
    return setting.interior_pixels > 0 ? setting.interior_px : missing;
}

std::string setting_tip(const TradeSetting& setting) {
    return setting.name + (setting.options.empty() ? "" : " (" + setting.options + ")") + "\n" +
           figure(setting.gpu_ms) + " ms, " + grouped(setting.triangles) + " triangles, " +
           figure(megabytes(setting.bytes)) + " MB\nworst interior error " +
           (setting.interior_pixels > 0 ? figure(setting.interior_px) + " px" : "not measured") +
           (setting.on_front ? "\non the Pareto front" : "");
}

template <class Cost>
std::string settings_plot(const TradeReport& report, const PlotHead& head, const std::string& x_title,
                          const Cost& cost) {
    Scatter scatter;
    scatter.head = head;
    scatter.x_title = x_title;
    scatter.y_title = "Worst interior error (px)";
    scatter.join_front = head.id == "time";
    for (const TradeSetting& setting : report.settings)
        scatter.points.push_back({setting.name, setting_tip(setting), cost(setting),
                                  interior_or_missing(setting), setting.on_front});
    return scatter_svg(scatter);
}

std::string effect_tip(const std::string& effect, const std::string& what, double px, double m) {
    return effect + "\n" + what + ": " + figure(px) + " px, " + figure(m) + " m";
}

PlotRow effect_row(const EffectWorst& effect) {
    PlotRow row;
    row.name = effect.effect;
    row.joined = effect.measured_px.has_value();
    row.alarm = !effect.broken_in.empty();
    const std::string data = attribute("data-effect", effect.effect);
    row.points.push_back(
        {data, effect_tip(effect.effect, "predicted bound", effect.predicted_px, effect.predicted_m),
         effect.predicted_px, 0, 0});
    const std::string measured =
        effect.measured_px
            ? effect_tip(effect.effect, "measured worst", *effect.measured_px,
                         effect.measured_m.value_or(missing))
            : effect.effect + "\nnot measured" + (effect.remark.empty() ? "" : ": " + effect.remark);
    row.points.push_back({data, measured, effect.measured_px.value_or(missing), 1, 0});
    return row;
}

std::string key(int mark, const std::string& text) {
    return "<span>" + mark_svg(mark) + " " + escaped(text) + "</span>\n";
}

// Colours and shapes tell views apart as long as there are enough.
bool told_apart(std::size_t views) {
    return views <= static_cast<std::size_t>(most_distinct_marks);
}
int mark_of(std::size_t view, std::size_t views) {
    return told_apart(views) ? static_cast<int>(view) + 2 : 1;
}

struct ViewsPlot {
    const char* id;
    const char* label;
    const char* x_title;
    ErrorSummary TradeShot::*error;
    bool promised;
};

std::string views_plot(const TradeReport& report, const ViewsPlot& what) {
    const std::vector<std::string> views = views_of(report);
    RowPlot plot;
    plot.head = {what.id, what.label, full_width_px, 0};
    plot.x_title = what.x_title;
    plot.lanes = static_cast<int>(std::max<std::size_t>(views.size(), 1));
    for (const TradeSetting& setting : report.settings) {
        PlotRow row;
        row.name = setting.name;
        if (what.promised && setting.promised_px) {
            row.limit = setting.promised_px;
            row.limit_tip = setting.name + " promises at most " + figure(*setting.promised_px) + " px";
        }
        for (const TradeShot& shot : report.shots) {
            if (shot.setting != setting.name) continue;
            const auto view =
                static_cast<std::size_t>(std::find(views.begin(), views.end(), shot.view) - views.begin());
            const ErrorSummary& error = shot.*what.error;
            const double worst = largest_of(error).value_or(missing);
            row.points.push_back(
                {attribute("data-view", shot.view) + " " + attribute("data-setting", shot.setting),
                 shot.view + "\n" + shot.setting + ": worst " + figure(largest_of(error)) +
                     " px, 99 % within " + (error.count > 0 ? figure(error.p99) : "n/a") + " px",
                 worst, mark_of(view, views.size()), static_cast<int>(view)});
            row.alarm = row.alarm || (row.limit && error.count > 0 && !(worst <= *row.limit));
        }
        plot.rows.push_back(std::move(row));
    }
    return rows_svg(std::move(plot));
}

std::string views_key(const TradeReport& report) {
    const std::vector<std::string> views = views_of(report);
    std::string html = "<p class=\"keys\">\n";
    if (!told_apart(views.size()))
        html += key(1, "a view (point at it for its name); many on one place stand out");
    else
        for (std::size_t i = 0; i < views.size(); ++i) html += key(mark_of(i, views.size()), views[i]);
    return html + "</p>\n";
}

}  // namespace

std::string settings_plots_html(const TradeReport& report) {
    std::string html =
        "<section>\n<h2>What each setting costs, and how close it is</h2>\n<h3>Time and error</h3>\n"
        "<p>One point a setting: the median GPU time of the views, and the worst error of any drawn point in "
        "any view. Down and left is better. The line joins the Pareto front: those that no other setting "
        "equals in both and beats in one. Both axes are logarithmic.</p>\n";
    html += settings_plot(
        report, {"time", "GPU time against worst interior error, one point a setting", full_width_px, 480},
        "GPU time (ms, median of the views)", [](const TradeSetting& setting) { return setting.gpu_ms; });
    html += "<div class=\"pair\"><div>\n<h3>Triangles and error</h3>\n";
    html += settings_plot(
        report,
        {"triangles", "Triangles against worst interior error, one point a setting", half_width_px, 430},
        "Triangles (millions, all views)",
        [](const TradeSetting& setting) { return static_cast<double>(setting.triangles) / 1e6; });
    html += "</div><div>\n<h3>Memory read and error</h3>\n";
    html += settings_plot(
        report, {"bytes", "Bytes read against worst interior error, one point a setting", half_width_px, 430},
        "Pages read (MB, all views)", [](const TradeSetting& setting) { return megabytes(setting.bytes); });
    return html + "</div></div>\n</section>\n";
}

std::string effects_plot_html(const TradeReport& report) {
    RowPlot plot;
    plot.head = {"effects", "Predicted bound and measured worst of each effect, in pixels", full_width_px, 0};
    plot.x_title = "Error (px, worst of the views)";
    for (const EffectWorst& effect : worst_effects(report)) plot.rows.push_back(effect_row(effect));
    return "<section>\n<h2>Each effect, predicted and measured</h2>\n"
           "<p>The bound that is predicted before anything is drawn, and the worst that was measured. A "
           "bound "
           "holds when it lies to the right; the nearer the two, the more it tells.</p>\n<p "
           "class=\"keys\">\n" +
           key(0, "predicted bound") + key(1, "measured worst") + "</p>\n" + rows_svg(std::move(plot)) +
           effects_table_html(report) + "</section>\n";
}

std::string views_plots_html(const TradeReport& report) {
    return "<section>\n<h2>Every view with every setting</h2>\n<h3>Interior</h3>\n"
           "<p>The worst error of a drawn point, one mark a view. A vertical bar is what the setting "
           "promises; "
           "marks to the right of it break the promise.</p>\n" +
           views_key(report) +
           views_plot(report, {"views", "Worst interior error of each view, by setting",
                               "Worst interior error (px)", &TradeShot::interior_px, true}) +
           "<h3>Skyline</h3>\n<p>How far the drawn skyline is from the true one, in the worst column of each "
           "view.</p>\n" +
           views_key(report) +
           views_plot(report, {"skylines", "Worst skyline error of each view, by setting",
                               "Worst skyline error (px)", &TradeShot::skyline_px, false}) +
           shots_table_html(report) + "</section>\n";
}

}  // namespace oro
