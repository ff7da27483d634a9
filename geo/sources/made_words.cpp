#include "geo/sources/made_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "geo/places/bounding_box.h"

namespace oro {
namespace {

struct KindWords {
    std::string_view name;
    MadeKind kind;
    std::string_view keys;  // beside H, spacing and box, each between commas
};
constexpr std::array made_kinds{
    KindWords{"fbm", MadeKind::fbm, ",seed,octaves,gain,feature,"},
    KindWords{"ridged", MadeKind::ridged, ",seed,octaves,gain,feature,"},
    KindWords{"plane", MadeKind::plane, ",azimuth,length,"},
    KindWords{"cone", MadeKind::cone, ",radius,"},
    KindWords{"sine", MadeKind::sine, ",azimuth,length,"},
    KindWords{"step", MadeKind::step, ",azimuth,"},
    KindWords{"sphere", MadeKind::sphere, ",radius,"},
    KindWords{"checker", MadeKind::checker, ","},
};

std::string kind_names() {
    std::string names;
    for (const KindWords& one : made_kinds) {
        if (&one == &made_kinds.back())
            names += " or ";
        else if (!names.empty())
            names += ", ";
        names += one.name;
    }
    return names;
}

std::string keys_of(const KindWords& kind) {
    std::string keys = "H, spacing, box";
    for (std::size_t from = 1; from < kind.keys.size();) {
        const std::size_t end = kind.keys.find(',', from);
        keys += ", " + std::string(kind.keys.substr(from, end - from));
        from = end + 1;
    }
    return keys;
}

std::optional<double> number_of(std::string_view text) {
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

struct Range {
    double low, high;
    const char* words;
};

std::optional<double> number_in(std::string_view text, const Range& range, bool whole) {
    const auto value = number_of(text);
    if (!value || *value < range.low || *value > range.high) return std::nullopt;
    if (whole && *value != std::floor(*value)) return std::nullopt;
    return value;
}

// Reads one text, part by part. Each setter gives why a value is none, or nothing.
class MadeText {
  public:
    explicit MadeText(const std::string& text) : text_(text) {}

    Result<MadeTerrain> read() {
        const std::string_view all = std::string_view(text_).substr(std::string_view("made:").size());
        const std::size_t mark = all.find('?');
        const std::string_view kind = all.substr(0, mark);
        const auto known = std::ranges::find(made_kinds, kind, &KindWords::name);
        if (known == made_kinds.end())
            return fault("its kind must be " + kind_names() + ", e.g. made:fbm?seed=7&box=8,46,9,47");
        kind_ = &*known;
        made_.kind = kind_->kind;
        if (mark != std::string_view::npos) ORO_CHECK(read_keys(all.substr(mark + 1)));
        ORO_CHECK(lay_box());
        return with_defaults();
    }

  private:
    const std::string& text_;
    const KindWords* kind_{};
    MadeTerrain made_;
    BoundingBox box_{8.0, 46.0, 9.0, 47.0};
    std::optional<double> feature_m_;

    [[nodiscard]] Error fault(const std::string& what) const { return {ErrorKind::usage, text_, what}; }

    Result<void> read_keys(std::string_view rest) {
        std::set<std::string_view> seen;
        while (true) {
            const std::size_t end = rest.find('&');
            const std::string_view part = rest.substr(0, end);
            const std::size_t equals = part.find('=');
            const std::string_view key = part.substr(0, equals);
            if (equals == std::string_view::npos)
                return fault("\"" + std::string(part) + "\" must be KEY=VALUE; keys are joined by &");
            if (!seen.insert(key).second) return fault("gives " + std::string(key) + " twice");
            ORO_CHECK(set(key, part.substr(equals + 1)));
            if (end == std::string_view::npos) return {};
            rest = rest.substr(end + 1);
        }
    }

    Result<void> set(std::string_view key, std::string_view value) {
        const auto out_of = [&](const std::string& must) {
            return fault(std::string(key) + " must be " + must + ", not \"" + std::string(value) + "\"");
        };
        if (key == "box") return set_box(value);
        if (key == "H") {
            if (!set_heights(value))
                return out_of(
                    "the lowest and the highest height in metres, from -8192 to 8192 and at least "
                    "0.01 m apart, e.g. -200:4000");
            return {};
        }
        if (key == "spacing") {
            if (!set_spacing(value))
                return out_of(
                    "a whole part of a degree from 0.1s to 1deg (s: seconds of arc, min, deg), "
                    "e.g. 1s, 3s, 0.5s or 2min");
            return {};
        }
        if (kind_->keys.find("," + std::string(key) + ",") == std::string_view::npos || key.empty())
            return fault("\"" + std::string(key) + "\" is no key of made:" + std::string(kind_->name) +
                         ", which has " + keys_of(*kind_));
        const Range range = range_of(key);
        const bool whole =
            key == "seed" || key == "octaves" || key == "azimuth" || key == "length" || key == "radius";
        const auto number = number_in(value, range, whole);
        if (!number) return out_of(range.words);
        take(key, *number);
        return {};
    }

    static Range range_of(std::string_view key) {
        if (key == "seed") return {0.0, 4294967295.0, "a whole number from 0 to 4294967295"};
        if (key == "octaves") return {1.0, 24.0, "a whole number from 1 to 24"};
        if (key == "gain") return {0.3, 0.9, "a number from 0.3 to 0.9"};
        if (key == "feature") return {1.0, 2e6, "metres from 1 to 2000000"};
        if (key == "azimuth") return {0.0, 359.0, "whole degrees from 0 to 359, clockwise from north"};
        if (key == "radius") return {1.0, 1e6, "whole metres from 1 to 1000000"};
        return {1.0, 4e7, "whole metres from 1 to 40000000"};  // length
    }

    void take(std::string_view key, double number) {
        const auto whole = static_cast<std::uint32_t>(number);
        if (key == "seed") made_.seed = whole;
        if (key == "octaves") made_.octaves = whole;
        if (key == "gain") made_.gain = static_cast<std::uint32_t>(std::lround(number * 1000.0));
        if (key == "feature") feature_m_ = number;
        if (key == "azimuth") made_.azimuth_deg = whole;
        if (key == "radius") made_.radius_m = whole;
        if (key == "length") made_.length_m = whole;
    }

    Result<void> set_box(std::string_view value) {
        auto box = parse_bounding_box(std::string(value));
        if (!box) return fault("box " + std::string(value) + ": " + box.error().what);
        box_ = *box;
        return {};
    }

    bool set_heights(std::string_view value) {
        const std::size_t colon = value.find(':');
        if (colon == std::string_view::npos) return false;
        // Whole steps up to there are exact as float.
        const Range range{-8192.0, 8192.0, ""};
        const auto low = number_in(value.substr(0, colon), range, false);
        const auto high = number_in(value.substr(colon + 1), range, false);
        if (!low || !high || *high - *low < 0.01) return false;
        made_.low = static_cast<std::int32_t>(std::lround(*low / made_step_m));
        made_.high = static_cast<std::int32_t>(std::lround(*high / made_step_m));
        return true;
    }

    bool set_spacing(std::string_view value) {
        double per_deg = 0.0;
        for (const auto& [unit, parts] :
             {std::pair<std::string_view, double>{"min", 60.0}, {"deg", 1.0}, {"s", 3600.0}}) {
            if (!value.ends_with(unit)) continue;
            const auto number = number_of(value.substr(0, value.size() - unit.size()));
            if (!number || *number <= 0.0) return false;
            per_deg = parts / *number;
            break;
        }
        const double whole = std::round(per_deg);
        if (!(whole >= 1.0 && whole <= 36000.0) || std::abs(per_deg - whole) > 1e-6 * whole) return false;
        made_.posts_per_deg = static_cast<std::int64_t>(whole);
        return true;
    }

    // Outwards to the next posts.
    Result<void> lay_box() {
        constexpr double on_post = 1e-6;
        const auto per_deg = static_cast<double>(made_.posts_per_deg);
        const double east = box_.east_deg <= box_.west_deg ? box_.east_deg + 360.0 : box_.east_deg;
        made_.west = static_cast<std::int64_t>(std::floor(box_.west_deg * per_deg + on_post));
        made_.east = static_cast<std::int64_t>(std::ceil(east * per_deg - on_post));
        made_.south = static_cast<std::int64_t>(std::floor(box_.south_deg * per_deg + on_post));
        made_.north = static_cast<std::int64_t>(std::ceil(box_.north_deg * per_deg - on_post));
        const std::int64_t turn = 360 * made_.posts_per_deg;
        if (made_.east - made_.west > turn) made_.east = made_.west + turn;
        if (made_.west >= turn / 2) {
            made_.west -= turn;
            made_.east -= turn;
        }
        return {};
    }

    Result<MadeTerrain> with_defaults() {
        const std::int64_t across_m =
            std::max<std::int64_t>(1, (made_.north - made_.south) * 111195 / made_.posts_per_deg);
        if (made_.length_m == 0)
            made_.length_m = static_cast<std::uint32_t>(
                made_.kind == MadeKind::sine ? std::max<std::int64_t>(1, across_m / 4) : across_m);
        if (made_.radius_m == 0)
            made_.radius_m = static_cast<std::uint32_t>(std::clamp<std::int64_t>(across_m / 2, 1, 1000000));
        if (feature_m_)
            made_.cell_shift =
                static_cast<std::uint32_t>(std::clamp(std::lround(std::log2(*feature_m_ * 192.0)), 7L, 28L));
        // Cells narrower than a third of a metre show nothing that heights could hold.
        constexpr std::uint32_t least_shift = 6;
        if (made_.kind == MadeKind::fbm || made_.kind == MadeKind::ridged) {
            const std::uint32_t most = made_.cell_shift - least_shift + 1;
            if (made_.octaves > most)
                return fault("octaves must be at most " + std::to_string(most) +
                             " with this feature: the last one's cells would be smaller than 0.3 m");
        }
        return made_;
    }
};

}  // namespace

bool is_made(std::string_view path) {
    return path.starts_with("made:");
}

Result<MadeTerrain> made_terrain_of(const std::string& text) {
    return MadeText(text).read();
}

}  // namespace oro
