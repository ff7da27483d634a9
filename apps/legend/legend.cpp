#include "apps/legend/legend.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>

#include "apps/command_line/refusals.h"
#include "apps/legend/colour_key.h"
#include "apps/legend/strip.h"
#include "apps/report/figures.h"

namespace oro {
namespace {

constexpr int least_width_px = 200;
constexpr StripColour paper{250, 248, 242}, ink{38, 40, 44}, quiet{110, 112, 116}, rule{206, 202, 192};

// Words on lines of so many pixels at most; what does not fit on one goes on, indented by nothing.
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

// Draws the parts one below the other, or beside each other, where the picture is wide.
class LegendPage {
  public:
    LegendPage(const View& view, const Region& region, const Style& style,
               const std::optional<SeenPlace>& middle, const TextFace& face)
        : view_(view), middle_(middle), face_(face), key_(colour_key(view, region, style)) {
        width_px_ = view.camera.width_px;
        em_ = std::clamp(width_px_ / 92.0, 11.0, 26.0);
        margin_ = 1.4 * em_;
    }

    Result<std::vector<std::uint8_t>> draw(const std::vector<std::string>& lines) {
        ORO_TRY(const std::vector<std::string> text, wrapped(face_, lines, em_, width_px_ - 2.0 * margin_));
        const double figure_px = 4.6 * em_, line_px = 1.5 * em_;
        const bool beside = width_px_ >= 52.0 * em_;
        const bool has_key = key_.shape != KeyShape::none;
        const double figures_px = figure_px + (has_key && !beside ? figure_px : 0.0);
        const double height =
            2.0 * margin_ + figures_px + 0.9 * em_ + line_px * static_cast<double>(text.size()) - 0.5 * em_;
        Strip strip(width_px_, static_cast<int>(std::ceil(height)), paper);
        strip.fill({0.0, 0.0}, {static_cast<double>(width_px_), std::max(1.0, std::round(em_ / 12.0))}, rule);
        ORO_CHECK(draw_north(strip, {margin_, margin_}));
        ORO_CHECK(draw_scale(strip, {margin_ + 7.0 * em_, margin_}));
        if (has_key)
            ORO_CHECK(draw_key(strip, beside ? glm::dvec2(margin_ + 28.0 * em_, margin_)
                                             : glm::dvec2(margin_, margin_ + figure_px)));
        double base = margin_ + figures_px + 0.9 * em_ + 0.8 * em_;
        for (const std::string& line : text) {
            ORO_CHECK(strip.write(face_, line, {margin_, base}, em_, ink));
            base += line_px;
        }
        return strip.rgb();
    }

  private:
    // A needle: its north half dark, its south half outlined, N at its end; turned as north is.
    Result<void> draw_north(Strip& strip, glm::dvec2 at) const {
        const double turn = north_in_picture_deg(view_, middle_) * std::numbers::pi / 180.0;
        const glm::dvec2 north(std::sin(turn), -std::cos(turn)), across(-north.y, north.x);
        const double reach = 1.75 * em_, half = 0.42 * em_;
        const glm::dvec2 centre = at + glm::dvec2(2.3 * em_, 2.1 * em_);
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

    // A bar of a round length, as long as that is across the picture in its middle.
    Result<void> draw_scale(Strip& strip, glm::dvec2 at) const {
        const std::string where = view_.map ? "at the map's middle" : "at the picture's middle";
        const auto metres = metres_a_pixel(view_, middle_);
        if (!metres || !(*metres > 0.0))
            return strip.write(face_, "the middle shows the sky: no scale", {at.x, at.y + 2.5 * em_},
                               0.9 * em_, quiet);
        const double length_m = round_length(13.0 * em_ * *metres), length_px = length_m / *metres;
        const double top = at.y + 1.9 * em_, tall = std::max(3.0, std::round(0.42 * em_));
        strip.fill({at.x, top}, {length_px, tall}, ink);
        const double line = std::max(1.0, std::round(em_ / 14.0));
        strip.fill({at.x + 0.5 * length_px, top + line}, {0.5 * length_px - line, tall - 2.0 * line}, paper);
        const std::string length =
            length_m >= 1000.0 ? figure_of(length_m / 1000.0) + " km" : figure_of(length_m) + " m";
        ORO_CHECK(strip.write(face_, "0", {at.x, top - 0.5 * em_}, 0.9 * em_, ink, Strip::From::middle));
        ORO_CHECK(strip.write(face_, length, {at.x + length_px, top - 0.5 * em_}, 0.9 * em_, ink,
                              Strip::From::middle));
        const std::string away =
            view_.map || !middle_ ? "" : ", " + distance_text(middle_->seen_distance_m) + " away";
        return strip.write(face_, where + away, {at.x, top + tall + 1.3 * em_}, 0.9 * em_, quiet);
    }

    Result<void> draw_key(Strip& strip, glm::dvec2 at) const {
        if (key_.shape == KeyShape::wheel) return draw_wheel(strip, at);
        if (key_.shape == KeyShape::names) return draw_names(strip, at);
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

    // Squares of the colours, each with its name; on a second line where there are many.
    Result<void> draw_names(Strip& strip, glm::dvec2 at) const {
        const double side = 1.1 * em_;
        double top = at.y + 1.55 * em_;
        ORO_CHECK(strip.write(face_, key_.title, {at.x, at.y + 0.85 * em_}, 0.9 * em_, quiet));
        double x = at.x;
        for (const ColourKey::Named& named : key_.names) {
            ORO_TRY(const double wide, face_.width_px(named.name, 0.9 * em_));
            if (x > at.x && x + 1.4 * em_ + wide > width_px_ - margin_) {
                x = at.x;
                top += 1.6 * em_;
            }
            strip.fill({x - 1.0, top - 1.0}, {side + 2.0, side + 2.0}, quiet);
            strip.fill({x, top}, {side, side}, named.colour);
            ORO_CHECK(strip.write(face_, named.name, {x + 1.4 * em_, top + 0.85 * em_}, 0.9 * em_, ink));
            x += 2.2 * em_ + wide;
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

int rows_of_strip(const std::vector<std::uint8_t>& strip, int width_px) {
    return static_cast<int>(strip.size() / (3 * static_cast<std::size_t>(width_px)));
}

Result<std::vector<std::uint8_t>> legend_strip(const View& view, const Region& region, const Style& style,
                                               const std::optional<SeenPlace>& middle) {
    if (view.camera.width_px < least_width_px)
        return refused("--legend", "", "needs a picture at least 200 px wide");
    ORO_TRY(const TextFace face, TextFace::open());
    LegendPage page(view, region, style, middle, face);
    return page.draw(legend_lines(view, region, style));
}

}  // namespace oro
