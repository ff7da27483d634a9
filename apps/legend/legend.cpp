#include "apps/legend/legend.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "apps/command_line/refusals.h"
#include "apps/legend/colour_key.h"
#include "apps/legend/key_names.h"
#include "apps/legend/strip.h"
#include "apps/report/figures.h"

namespace oro {
namespace {

constexpr StripColour paper = legend_paper, ink = legend_ink, quiet = legend_quiet, rule{206, 202, 192};

// Draws the parts one below the other, or beside each other, where the picture is wide.
class LegendPage {
  public:
    LegendPage(const View& view, const Region& region, const Style& style,
               const std::optional<SeenPlace>& middle, const ShownGround& shown, const TextFace& face)
        : view_(view), middle_(middle), face_(face), key_(colour_key(view, region, style, 1, &shown)) {
        width_px_ = view.camera.width_px;
        em_ = std::clamp(width_px_ / 92.0, 11.0, 26.0);
        margin_ = 1.4 * em_;
    }

    Result<std::vector<std::uint8_t>> draw(const std::vector<std::string>& lines) {
        ORO_TRY(const std::vector<std::string> text, wrapped(face_, lines, em_, width_px_ - 2.0 * margin_));
        const bool in_one_row = width_px_ >= 52.0 * em_;
        const double scale_room_px = in_one_row ? 20.0 * em_ : width_px_ - 2.0 * margin_ - scale_em * em_;
        ORO_TRY(const std::vector<std::string> caption,
                wrapped(face_, {scale_caption()}, 0.9 * em_, scale_room_px));
        const double figure_px = (4.6 + caption_line_em * static_cast<double>(caption.size() - 1)) * em_;
        const double line_px = 1.5 * em_;
        const glm::dvec2 key_at =
            in_one_row ? glm::dvec2(margin_ + 28.0 * em_, margin_) : glm::dvec2(margin_, margin_ + figure_px);
        double key_px = key_.shape == KeyShape::none ? 0.0 : figure_px;
        PlacedNames names;
        if (key_.shape == KeyShape::names) {
            ORO_TRY(names, place_names(face_, key_, key_at, width_px_ - margin_, em_));
            // A title alone needs a line.
            key_px = key_.names.empty() ? 1.3 * em_ * static_cast<double>(names.title.size())
                                        : std::max(key_px, names.bottom_px - key_at.y + 0.3 * em_);
        }
        const double figures_px = in_one_row ? std::max(figure_px, key_px) : figure_px + key_px;
        const double height =
            2.0 * margin_ + figures_px + 0.9 * em_ + line_px * static_cast<double>(text.size()) - 0.5 * em_;
        Strip strip(width_px_, static_cast<int>(std::ceil(height)), paper);
        strip.fill({0.0, 0.0}, {static_cast<double>(width_px_), std::max(1.0, std::round(em_ / 12.0))}, rule);
        ORO_CHECK(draw_north(strip, {margin_, margin_}));
        ORO_CHECK(draw_scale(strip, {margin_ + scale_em * em_, margin_}, scale_room_px, caption));
        ORO_CHECK(key_.shape == KeyShape::names ? draw_names(strip, face_, key_, names)
                                                : draw_key(strip, key_at));
        double base = margin_ + figures_px + 0.9 * em_ + 0.8 * em_;
        for (const std::string& line : text) {
            ORO_CHECK(strip.write(face_, line, {margin_, base}, em_, ink));
            base += line_px;
        }
        return strip.rgb();
    }

  private:
    static constexpr double scale_em = 7.0, caption_line_em = 1.2;  // from the left margin; of line to line

    // A needle: its north half dark, its south half outlined, N at its end; turned as north is around a point
    // half way from the needle's south end to that of the letter, so that both stay within 2.25 em of it.
    Result<void> draw_north(Strip& strip, glm::dvec2 at) const {
        const double turn = north_in_picture_deg(view_, middle_) * std::numbers::pi / 180.0;
        const glm::dvec2 north(std::sin(turn), -std::cos(turn)), across(-north.y, north.x);
        const double reach = 1.75 * em_, half = 0.42 * em_;
        const glm::dvec2 centre = at + glm::dvec2(2.3 * em_, 2.25 * em_) - 0.5 * em_ * north;
        const auto in_needle = [&](glm::dvec2 place, double sign, double shrink) {
            const glm::dvec2 off = place - centre;
            const double along = sign * glm::dot(off, north), side = std::abs(glm::dot(off, across));
            return along >= shrink && side <= (half - 1.2 * shrink) * (1.0 - (along + 2.0 * shrink) / reach);
        };
        const glm::dvec2 corner = centre - 2.0 * em_, size(4.0 * em_);
        strip.paint(
            corner, size, [&](glm::dvec2 p) { return in_needle(p, 1.0, 0.0); }, ink);
        strip.paint(
            corner, size, [&](glm::dvec2 p) { return in_needle(p, -1.0, 0.0); }, quiet);
        strip.paint(
            corner, size, [&](glm::dvec2 p) { return in_needle(p, -1.0, 0.09 * em_); }, paper);
        const glm::dvec2 letter = centre + (reach + 0.62 * em_) * north;
        return strip.write(face_, "N", {letter.x, letter.y + 0.365 * em_}, em_, ink, Strip::From::middle);
    }

    [[nodiscard]] bool has_scale() const { return metres_a_pixel(view_, middle_).value_or(0.0) > 0.0; }

    [[nodiscard]] std::string scale_caption() const {
        if (!has_scale()) return "the middle shows the sky: no scale";
        if (view_.map) return "at the map's middle";
        return "at the picture's middle" +
               (middle_ ? ", " + distance_text(middle_->seen_distance_m) + " away" : "");
    }

    Result<void> write_caption(Strip& strip, glm::dvec2 base, const std::vector<std::string>& caption) const {
        for (const std::string& line : caption) {
            ORO_CHECK(strip.write(face_, line, base, 0.9 * em_, quiet));
            base.y += caption_line_em * em_;
        }
        return {};
    }

    // A bar of a round length, as long as that is across the picture in its middle.
    Result<void> draw_scale(Strip& strip, glm::dvec2 at, double room_px,
                            const std::vector<std::string>& caption) const {
        if (!has_scale()) return write_caption(strip, {at.x, at.y + 2.5 * em_}, caption);
        const double metres = *metres_a_pixel(view_, middle_);
        // The figure at its end stands half beyond it.
        const double longest_px = std::min(13.0 * em_, room_px - 1.5 * em_);
        const double length_m = round_length(longest_px * metres), length_px = length_m / metres;
        const double top = at.y + 1.9 * em_, tall = std::max(3.0, std::round(0.42 * em_));
        strip.fill({at.x, top}, {length_px, tall}, ink);
        const double line = std::max(1.0, std::round(em_ / 14.0));
        strip.fill({at.x + 0.5 * length_px, top + line}, {0.5 * length_px - line, tall - 2.0 * line}, paper);
        const std::string length =
            length_m >= 1000.0 ? figure_of(length_m / 1000.0) + " km" : figure_of(length_m) + " m";
        ORO_CHECK(strip.write(face_, "0", {at.x, top - 0.5 * em_}, 0.9 * em_, ink, Strip::From::middle));
        ORO_CHECK(strip.write(face_, length, {at.x + length_px, top - 0.5 * em_}, 0.9 * em_, ink,
                              Strip::From::middle));
        return write_caption(strip, {at.x, top + tall + 1.3 * em_}, caption);
    }

    // A bar or a wheel.
    Result<void> draw_key(Strip& strip, glm::dvec2 at) const {
        if (key_.shape == KeyShape::none) return {};
        if (key_.shape == KeyShape::wheel) return draw_wheel(strip, at);
        const double wide = std::min(22.0 * em_, width_px_ - margin_ - at.x - em_), tall = 1.1 * em_;
        const double top = at.y + 1.55 * em_;
        ORO_CHECK(strip.write(face_, key_.title, {at.x, at.y + 0.85 * em_}, 0.9 * em_, quiet));
        // Light colours end at a frame, not in the paper.
        strip.fill({at.x - 1.0, top - 1.0}, {wide + 2.0, tall + 2.0}, quiet);
        strip.fill({at.x, top}, {wide, tall}, [&](glm::dvec2 share) {
            return key_.colour(key_.low + share.x * (key_.high - key_.low));
        });
        for (const double tick : key_.ticks) {
            const double x = at.x + wide * (tick - key_.low) / (key_.high - key_.low);
            strip.fill({std::round(x) - 0.5, top + tall}, {1.0, 0.35 * em_}, ink);
            const std::string text = (tick < 0.0 ? "−" : "") +
                                     grouped(static_cast<std::uint64_t>(std::lround(std::abs(tick)))) +
                                     key_.unit;
            ORO_CHECK(
                strip.write(face_, text, {x, top + tall + 1.35 * em_}, 0.9 * em_, ink, Strip::From::middle));
        }
        return {};
    }

    // By direction, as on a compass.
    Result<void> draw_wheel(Strip& strip, glm::dvec2 at) const {
        const double outer = 1.55 * em_, inner = 0.6 * em_;
        const glm::dvec2 centre = at + glm::dvec2(9.5 * em_, 2.25 * em_);
        ORO_CHECK(strip.write(face_, key_.title, {at.x, centre.y + 0.33 * em_}, 0.9 * em_, quiet));
        for (int degrees = 0; degrees < 360; degrees += 3) {
            const auto in_slice = [&](glm::dvec2 place) {
                const glm::dvec2 off = place - centre;
                const double away = glm::length(off),
                             turned = std::atan2(off.x, -off.y) * 180.0 / std::numbers::pi;
                return away >= inner && away <= outer &&
                       std::abs(std::remainder(turned - degrees, 360.0)) <= 1.6;
            };
            strip.paint(centre - outer, glm::dvec2(2.0 * outer), in_slice, key_.colour(degrees));
        }
        const double out = outer + 0.6 * em_;
        for (const auto& [letter, to] : {std::pair{"N", glm::dvec2(0.0, -1.0)},
                                         {"E", {1.0, 0.0}},
                                         {"S", {0.0, 1.0}},
                                         {"W", {-1.0, 0.0}}})
            ORO_CHECK(strip.write(face_, letter, centre + out * to + glm::dvec2(0.0, 0.3 * em_), 0.8 * em_,
                                  ink, Strip::From::middle));
        return {};
    }

    static std::string figure_of(double value) {
        return grouped(static_cast<std::uint64_t>(std::lround(value)));
    }
    static std::string distance_text(double value_m) {
        return value_m >= 1000.0 ? figure(value_m / 1000.0) + " km" : figure(value_m) + " m";
    }

    const View& view_;
    const std::optional<SeenPlace>& middle_;
    const TextFace& face_;
    ColourKey key_;
    int width_px_{};
    double em_{}, margin_{};
};

}  // namespace

bool has_own_legend(const View& view) {
    return view.show && !view.map && view.camera.width_px >= least_legend_px;
}

Result<std::vector<std::uint8_t>> legend_strip(const View& view, const Region& region, const Style& style,
                                               const std::optional<SeenPlace>& middle,
                                               const RegionGround& ground) {
    if (view.camera.width_px < least_legend_px)
        return refused("--legend", "", "needs a picture at least 200 px wide");
    ORO_TRY(const TextFace face, TextFace::open());
    ORO_TRY(const ShownGround shown, ground_shown(view, ground));
    LegendPage page(view, region, style, middle, shown, face);
    return page.draw(legend_lines(view, region, style, &shown));
}

Result<std::vector<std::uint8_t>> strip_of(View& view, const Region& region, const Style& style,
                                           const std::optional<SeenPlace>& middle,
                                           const RegionGround& ground) {
    view.legend_px = 0;
    std::vector<std::uint8_t> strip;
    if (!view.legend) return strip;
    ORO_TRY(strip, legend_strip(view, region, style, middle, ground));
    view.legend_px = static_cast<int>(strip.size() / (3 * static_cast<std::size_t>(view.camera.width_px)));
    return strip;
}

}  // namespace oro
