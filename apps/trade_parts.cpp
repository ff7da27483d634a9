#include "apps/trade_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oro {
namespace {

// Length of the UTF-8 sequence at the start of `text`, or 0 where there is none that Unicode allows.
// Source: The Unicode Standard 15, table 3-7.
std::size_t sequence_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    if (length == 0 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    const unsigned char second = byte(1);
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F)) return 0;  // overlong, surrogate
    if ((lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) return 0;  // overlong, too high
    return length;
}

// U+0000 to U+001F, U+007F to U+009F.
bool is_control(std::string_view sequence) {
    const auto lead = static_cast<unsigned char>(sequence[0]);
    if (sequence.size() == 1) return lead < 0x20 || lead == 0x7F;
    return lead == 0xC2 && static_cast<unsigned char>(sequence[1]) < 0xA0;
}

void widen(std::optional<RatioRange>& range, const std::optional<double>& ratio) {
    if (!ratio) return;
    if (!range) range = RatioRange{*ratio, *ratio};
    range->least = std::min(range->least, *ratio);
    range->most = std::max(range->most, *ratio);
}

void widen(std::optional<double>& worst, const std::optional<double>& value) {
    if (value) worst = worst ? worse(*worst, *value) : *value;
}

void add(EffectWorst& worst, const TradeEffect& effect) {
    worst.predicted_m = worse(worst.predicted_m, effect.predicted_m);
    worst.predicted_px = worse(worst.predicted_px, effect.predicted_px);
    widen(worst.measured_m, effect.measured_m);
    widen(worst.measured_px, effect.measured_px);
    widen(worst.ratio_m, bound_ratio(effect.predicted_m, effect.measured_m));
    widen(worst.ratio_px, bound_ratio(effect.predicted_px, effect.measured_px));
    if (!effect.remark.empty() && worst.remark.find(effect.remark) == std::string::npos)
        worst.remark += (worst.remark.empty() ? "" : "; ") + effect.remark;
    if (bound_broken(effect)) worst.broken_in.push_back(effect.view);
    ++worst.views;
    if (effect.measured_m || effect.measured_px) ++worst.measured_views;
}

}  // namespace

double megabytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / 1e6;
}

std::optional<double> largest_of(const ErrorSummary& summary) {
    if (summary.count == 0) return std::nullopt;
    return summary.largest;
}

std::string valid_text(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        const std::string_view sequence = text.substr(0, std::max<std::size_t>(length, 1));
        if (length == 0 || is_control(sequence))
            valid += "\xEF\xBF\xBD";
        else
            valid += sequence;
        text.remove_prefix(sequence.size());
    }
    return valid;
}

std::string escaped(std::string_view text) {
    std::string html;
    for (const char c : valid_text(text)) {
        switch (c) {
            case '&':
                html += "&amp;";
                break;
            case '<':
                html += "&lt;";
                break;
            case '>':
                html += "&gt;";
                break;
            case '"':
                html += "&quot;";
                break;
            case '\'':
                html += "&#39;";
                break;
            default:
                html += c;
        }
    }
    return html;
}

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8U | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[three >> (18U - 6U * k) & 63U] : '=';
    }
    return text;
}

double worse(double a, double b) {
    if (std::isnan(a)) return a;
    return a > b ? a : b;
}

bool bound_broken(const TradeEffect& effect) {
    // Not "measured > predicted": a bound that is no number holds nothing.
    return (effect.measured_m && !(*effect.measured_m <= effect.predicted_m)) ||
           (effect.measured_px && !(*effect.measured_px <= effect.predicted_px));
}

std::optional<double> bound_ratio(double predicted, const std::optional<double>& measured) {
    if (!measured || !(*measured > 0.0)) return std::nullopt;
    return predicted / *measured;
}

std::vector<EffectWorst> worst_effects(const TradeReport& report) {
    std::vector<EffectWorst> effects;
    for (const TradeEffect& effect : report.effects) {
        auto at = std::find_if(effects.begin(), effects.end(),
                               [&](const EffectWorst& worst) { return worst.effect == effect.effect; });
        if (at == effects.end()) {
            at = effects.emplace(effects.end());
            at->effect = effect.effect;
        }
        add(*at, effect);
    }
    return effects;
}

std::vector<std::string> views_of(const TradeReport& report) {
    std::vector<std::string> views;
    for (const TradeShot& shot : report.shots)
        if (std::find(views.begin(), views.end(), shot.view) == views.end()) views.push_back(shot.view);
    return views;
}

}  // namespace oro
