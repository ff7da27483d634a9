#include "apps/trade/trade_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/report/base64.h"
#include "apps/report/json_object.h"
#include "apps/trade/trade_parts.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// What is no number is null in JSON by itself.
ordered_json number(double value) {
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    return value;
}
ordered_json number(const std::optional<double>& value) {
    return value ? number(*value) : ordered_json(nullptr);
}
ordered_json known(bool is, double value) {
    return is ? number(value) : ordered_json(nullptr);
}
ordered_json range(const std::optional<RatioRange>& ratio) {
    if (!ratio) return nullptr;
    return json_list(number(ratio->least), number(ratio->most));
}
std::optional<RatioRange> as_range(const std::optional<double>& ratio) {
    if (!ratio) return std::nullopt;
    return RatioRange{*ratio, *ratio};
}

template <class Items, class Find>
std::size_t index_of(const Items& items, const Find& is_it) {
    return static_cast<std::size_t>(std::find_if(items.begin(), items.end(), is_it) - items.begin());
}

ordered_json cost_json(const TradeCost& cost) {
    return json_object("gpu_ms", number(cost.gpu_ms), "triangles", cost.triangles);
}

ordered_json setting_json(const TradeSetting& setting) {
    const bool ground = setting.displacement_pixels > 0;
    ordered_json json = ordered_json::object();
    json["name"] = name_of(setting.key);
    json["options"] = valid_text(setting.options);
    json["limit_px"] = number(setting.limit_px);
    json["first"] = cost_json(setting.first);
    json["settled"] = cost_json(setting.settled);
    json["bytes"] = setting.bytes;
    json["ground_m"] = known(ground, setting.displacement_m);
    json["ground_px"] = known(ground, setting.displacement_px);
    json["ground_p99_px"] = known(ground, setting.displacement_p99_px);
    json["ground_mean_px"] = known(ground, setting.displacement_mean_px);
    json["surface_px"] = known(ground, setting.surface_px);
    json["seen_px"] = known(ground, setting.seen_px);
    json["skyline_px"] = known(setting.skyline_columns > 0, setting.skyline_px);
    json["at_least"] = json_object("ground_px", setting.displacement_px_at_least, "surface_px",
                                   setting.surface_px_at_least, "seen_px", setting.seen_px_at_least);
    json["over_limit"] = setting.over_limit;
    json["best"] = setting.on_front;
    return json;
}

ordered_json summary_json(const ErrorSummary& of) {
    return json_object("worst", number(of.largest), "p9999", number(of.p9999), "p99", number(of.p99), "mean",
                       number(of.mean), "count", of.count, "at_least", of.at_least);
}

ordered_json shot_json(const TradeReport& report, const std::vector<std::string>& views,
                       const TradeShot& shot) {
    const auto view = index_of(views, [&](const std::string& name) { return name == shot.view; });
    const auto setting =
        index_of(report.settings, [&](const TradeSetting& one) { return one.key == shot.setting; });
    ordered_json json = ordered_json::object();
    json["view"] = view;
    json["setting"] = setting;
    json["first"] = cost_json(shot.first);
    json["settled"] = cost_json(shot.settled);
    json["bytes"] = shot.bytes;
    json["ground_m"] = summary_json(shot.displacement_m);
    json["ground_px"] = summary_json(shot.displacement_px);
    json["surface_px"] = summary_json(shot.surface_px);
    json["seen_px"] = summary_json(shot.seen_px);
    json["skyline_px"] = summary_json(shot.skyline_px);
    json["skyline_in_one_only"] = shot.skyline_in_one_only;
    return json;
}

ordered_json effect_json(const EffectWorst& effect) {
    ordered_json json = ordered_json::object();
    json["name"] = name_of(effect.key);
    json["predicted_m"] = known(is_predicted(effect.key), effect.predicted_m);
    json["measured_m"] = number(effect.measured_m);
    json["ratio_m"] = range(effect.ratio_m);
    json["predicted_px"] = known(is_predicted(effect.key), effect.predicted_px);
    json["measured_px"] = number(effect.measured_px);
    json["ratio_px"] = range(effect.ratio_px);
    json["over_in"] = effect.broken_in.size();
    json["measured_views"] = effect.measured_views;
    json["remark"] = remark_on(effect.measured_by);
    return json;
}

ordered_json effect_json(const TradeEffect& effect) {
    ordered_json json = ordered_json::object();
    json["view"] = valid_text(effect.view);
    json["name"] = name_of(effect.key);
    json["predicted_m"] = known(is_predicted(effect.key), effect.predicted_m);
    json["measured_m"] = number(effect.measured_m);
    json["ratio_m"] = range(as_range(ratio_m(effect)));
    json["predicted_px"] = known(is_predicted(effect.key), effect.predicted_px);
    json["measured_px"] = number(effect.measured_px);
    json["ratio_px"] = range(as_range(ratio_px(effect)));
    json["over"] = bound_broken(effect);
    json["remark"] = remark_on(effect.measured_by);
    return json;
}

// How many pictures there are of settings with a limit, and how many of them are over it.
ordered_json limits_json(const TradeReport& report) {
    std::size_t pictures = 0;
    std::size_t over = 0;
    for (const TradeShot& shot : report.shots) {
        if (!shot.limit_px || shot.displacement_px.count == 0) continue;
        ++pictures;
        if (shot.over_limit()) ++over;
    }
    return json_object("pictures", pictures, "over", over);
}

ordered_json bounds_json(const TradeReport& report) {
    std::size_t measured = 0;
    std::size_t unmeasured = 0;
    std::size_t over = 0;
    std::size_t loose = 0;
    for (const TradeEffect& effect : report.effects) {
        if (!is_predicted(effect.key)) continue;
        if (!effect.measured_m && !effect.measured_px) {
            ++unmeasured;
            continue;
        }
        ++measured;
        if (bound_broken(effect)) ++over;
        if (bound_loose(effect)) ++loose;
    }
    return json_object("measured", measured, "over", over, "loose", loose, "unmeasured", unmeasured);
}

// Source: PNG, 11.2.2: width and height are the 16th to 23rd byte. What is no PNG has no size and no bytes.
ordered_json picture_json(const TradePicture& picture) {
    constexpr std::array<std::uint8_t, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    const std::vector<std::uint8_t>& png = picture.png;
    ordered_json json =
        json_object("title", valid_text(picture.title), "caption", valid_text(picture.caption));
    const bool is_png = png.size() >= 24 && std::equal(signature.begin(), signature.end(), png.begin());
    const auto side_px = [&](std::size_t at) {
        return is_png ? std::uint32_t{png[at]} << 24U | std::uint32_t{png[at + 1]} << 16U |
                            std::uint32_t{png[at + 2]} << 8U | png[at + 3]
                      : 0U;
    };
    json["size_px"] = json_list(side_px(16), side_px(20));
    json["png"] = is_png ? base64(png) : "";
    return json;
}

// JSON within HTML: nothing in it may look like a tag.
std::string json_for_html(const ordered_json& json) {
    std::string html;
    for (const char c : json.dump()) html += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return html;
}

}  // namespace

ordered_json trade_page_json(const TradeReport& report) {
    const std::vector<std::string> views = views_of(report);
    ordered_json json = ordered_json::object();
    for (const auto& [name, text] : {std::pair{"region", &report.region},
                                     {"command", &report.command},
                                     {"machine", &report.machine},
                                     {"gpu", &report.gpu},
                                     {"driver", &report.driver},
                                     {"pipeline", &report.pipeline},
                                     {"version", &report.version},
                                     {"time", &report.time}})
        json[name] = valid_text(*text);
    json["size_px"] = json_list(report.width_px, report.height_px);
    for (const char* list : {"views", "settings", "shots", "effects", "effects_of_views", "pictures"})
        json[list] = ordered_json::array();
    for (const std::string& view : views) json["views"].push_back(valid_text(view));
    for (const TradeSetting& setting : report.settings) json["settings"].push_back(setting_json(setting));
    for (const TradeShot& shot : report.shots) json["shots"].push_back(shot_json(report, views, shot));
    for (const EffectWorst& effect : worst_effects(report)) json["effects"].push_back(effect_json(effect));
    for (const TradeEffect& effect : report.effects) json["effects_of_views"].push_back(effect_json(effect));
    for (const TradePicture& picture : report.pictures) json["pictures"].push_back(picture_json(picture));
    json["limits"] = limits_json(report);
    json["bounds"] = bounds_json(report);
    json["loose_ratio"] = loose_ratio;
    return json;
}

std::string trade_html(const TradeReport& report) {
    // What the page must hold, said apart from the data that its script draws: a check compares the two.
    const std::string stated = " data-plots=\"" + std::to_string(trade_page_plots) + "\" data-settings=\"" +
                               std::to_string(report.settings.size()) + "\" data-shots=\"" +
                               std::to_string(report.shots.size()) + "\" data-effects=\"" +
                               std::to_string(worst_effects(report).size()) + "\" data-pictures=\"" +
                               std::to_string(report.pictures.size()) + "\"";
    return trade_page_before + stated + trade_page_middle + json_for_html(trade_page_json(report)) +
           trade_page_after;
}

}  // namespace oro
