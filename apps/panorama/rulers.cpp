#include "apps/panorama/rulers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"

namespace oro {
namespace {

struct Steps {
    double figures_deg;
    double ticks_deg;
};
constexpr std::array<Steps, 11> nice{{{0.01, 0.002},
                                      {0.02, 0.005},
                                      {0.05, 0.01},
                                      {0.1, 0.02},
                                      {0.2, 0.05},
                                      {0.5, 0.1},
                                      {1.0, 0.2},
                                      {2.0, 0.5},
                                      {5.0, 1.0},
                                      {10.0, 2.0},
                                      {30.0, 10.0}}};

// All of the em.
constexpr double tick_share = 0.45, long_tick_share = 0.8;
constexpr double figures_down_share = 1.55, winds_down_share = 2.95, text_down_share = 4.45;
constexpr double strip_share = 5.35;
constexpr double winds_size = 1.15, text_size = 0.8, side_size = 0.85;
constexpr SheetColour ink{24, 30, 42}, faint_ink{92, 98, 110}, light{250, 250, 246}, level_ink{250, 250, 246};

Steps steps_for(double px_per_deg, double room_px) {
    for (const Steps& steps : nice) {
        if (steps.figures_deg * px_per_deg >= room_px) return steps;
    }
    return nice.back();
}

std::string figure(double value, double step, const char* format_sign) {
    const int decimals = step < 0.099 ? 2 : step < 0.99 ? 1 : 0;
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), format_sign, decimals, value);
    return std::string(text.data()) + "°";
}

class Writer {
  public:
    Writer(const Rulers& rulers, const Cylinder& around, const TextFace& face, Sheet& sheet)
        : rulers_(rulers), around_(around), face_(face), sheet_(sheet), em_px_(rulers.em_px) {}

    Result<void> azimuths() {
        const double top_px = sheet_.scene_top_px + sheet_.scene_rows_px;
        sheet_.lines.push_back({{0.0, top_px}, {static_cast<double>(sheet_.width_px), top_px}, thin(), ink});
        const double first = std::ceil(around_.from_deg / rulers_.azimuth_tick_deg - 1e-9);
        const long per_figure = std::lround(rulers_.azimuth_step_deg / rulers_.azimuth_tick_deg);
        for (double i = first;; i += 1.0) {
            const double azimuth_deg = i * rulers_.azimuth_tick_deg, on_deg = azimuth_deg - around_.from_deg;
            if (on_deg > around_.sweep_deg + 1e-9) break;
            const double x = on_deg / around_.sweep_deg * around_.width_px;
            const bool has_figure = std::llround(i) % per_figure == 0;
            sheet_.lines.push_back({{x, top_px},
                                    {x, top_px + (has_figure ? long_tick_share : tick_share) * em_px_},
                                    thin(),
                                    ink});
            if (has_figure)
                ORO_CHECK(write(figure(turned_deg(azimuth_deg), rulers_.azimuth_step_deg, "%.*f"),
                                {x, top_px + figures_down_share * em_px_}, 1.0, ink, "azimuth"));
        }
        return winds(top_px);
    }

    Result<void> elevations() {
        const double low_deg = around_.elevation_deg_at(around_.height_px()),
                     high_deg = around_.elevation_deg_at(0.0);
        const long per_figure = std::lround(rulers_.elevation_step_deg / rulers_.elevation_tick_deg);
        for (double i = std::ceil(low_deg / rulers_.elevation_tick_deg);
             i * rulers_.elevation_tick_deg < high_deg; i += 1.0) {
            const double elevation_deg = i * rulers_.elevation_tick_deg;
            const double y = sheet_.scene_top_px +
                             around_.place_px({0.0, 1.0, std::tan(elevation_deg * 0.017453292519943295)}).y;
            const bool has_figure = std::llround(i) % per_figure == 0;
            ORO_CHECK(side_ticks(y, has_figure ? long_tick_share : tick_share));
            const bool fits = y > sheet_.scene_top_px + 0.6 * em_px_ &&
                              y < sheet_.scene_top_px + sheet_.scene_rows_px - 0.6 * em_px_;
            if (has_figure && fits)
                ORO_CHECK(side_figures(
                    figure(elevation_deg, rulers_.elevation_step_deg, i == 0.0 ? "%.*f" : "%+.*f"), y));
        }
        return {};
    }

    // The level line, over the scene.
    void level() {
        if (around_.above_px <= 0 || around_.below_px <= 0) return;
        const double y = sheet_.scene_top_px + around_.above_px, dash_px = 0.5 * em_px_;
        for (double x = 3.2 * em_px_; x < sheet_.width_px - 3.7 * em_px_; x += 6.0 * dash_px)
            sheet_.lines.push_back({{x, y}, {x + dash_px, y}, 0.6 * thin(), level_ink});
    }

    Result<void> tell(const std::string& left, const std::string& right) {
        const double y = sheet_.scene_top_px + sheet_.scene_rows_px + text_down_share * em_px_,
                     size_px = text_size * em_px_, border_px = 0.7 * em_px_;
        ORO_TRY(const double left_px, face_.width_px(left, size_px));
        ORO_TRY(const double right_px, face_.width_px(right, size_px));
        double free_px = sheet_.width_px - 2.0 * border_px;
        SheetText text{left, {border_px, y}, SheetText::Anchor::begin, 0.0, size_px, left_px, faint_ink,
                       {},   "eye"};
        if (left_px <= free_px) {
            free_px -= left_px + 2.0 * em_px_;
            sheet_.texts.push_back(text);
        }
        if (right_px > free_px || right.empty()) return {};
        sheet_.texts.push_back({right,
                                {sheet_.width_px - border_px, y},
                                SheetText::Anchor::end,
                                0.0,
                                size_px,
                                right_px,
                                faint_ink,
                                {},
                                "attribution"});
        return {};
    }

  private:
    [[nodiscard]] double thin() const { return std::max(1.0, 0.07 * em_px_); }

    // Centred at a place of a strip, moved inwards at its ends.
    Result<void> write(const std::string& text, glm::dvec2 at_px, double size, const SheetColour& colour,
                       const char* kind) {
        const double size_px = size * em_px_;
        ORO_TRY(const double length_px, face_.width_px(text, size_px));
        const double inset_px = 0.5 * length_px + 0.3 * em_px_;
        if (2.0 * inset_px > sheet_.width_px) return {};
        at_px.x = std::clamp(at_px.x, inset_px, sheet_.width_px - inset_px);
        // One that was moved must not come to stand on the one before.
        if (!sheet_.texts.empty()) {
            const SheetText& last = sheet_.texts.back();
            const bool same_row = last.kind == kind && last.at_px.y == at_px.y;
            if (same_row && at_px.x - 0.5 * length_px < last.at_px.x + 0.5 * last.length_px + 0.5 * em_px_)
                return {};
        }
        sheet_.texts.push_back(
            {text, at_px, SheetText::Anchor::middle, 0.0, size_px, length_px, colour, {}, kind});
        return {};
    }

    // Letters for as many directions as there is room for.
    Result<void> winds(double top_px) {
        const double px_per_deg = around_.width_px / around_.sweep_deg;
        const int every = 22.5 * px_per_deg >= 4.5 * em_px_ ? 1 : 45.0 * px_per_deg >= 4.0 * em_px_ ? 2 : 4;
        for (int i = 0; i <= 32; i += every) {
            const double on_deg = 22.5 * i - around_.from_deg;
            if (on_deg < -1e-9 || on_deg > around_.sweep_deg + 1e-9) continue;
            ORO_CHECK(write(compass_point(i % 16), {on_deg * px_per_deg, top_px + winds_down_share * em_px_},
                            i % 4 == 0 ? winds_size : 0.9, i % 4 == 0 ? ink : faint_ink, "wind"));
        }
        return {};
    }

    Result<void> side_ticks(double y, double share) {
        const double length_px = share * em_px_, right_px = sheet_.width_px;
        // Light around dark: they are read on snow and forest.
        for (const auto& [width_px, colour] : {std::pair{3.0 * thin(), light}, std::pair{thin(), ink}}) {
            sheet_.lines.push_back({{0.0, y}, {length_px, y}, width_px, colour});
            sheet_.lines.push_back({{right_px - length_px, y}, {right_px, y}, width_px, colour});
        }
        return {};
    }

    Result<void> side_figures(const std::string& text, double y) {
        const double size_px = side_size * em_px_, in_px = (long_tick_share + 0.35) * em_px_;
        ORO_TRY(const double length_px, face_.width_px(text, size_px));
        SheetText one{text,  {in_px, y}, SheetText::Anchor::begin, 0.0, size_px, length_px, ink,
                      light, "elevation"};
        sheet_.texts.push_back(one);
        one.anchor = SheetText::Anchor::end;
        one.at_px.x = sheet_.width_px - in_px;
        sheet_.texts.push_back(std::move(one));
        return {};
    }

    const Rulers& rulers_;
    const Cylinder& around_;
    const TextFace& face_;
    Sheet& sheet_;
    double em_px_;
};

}  // namespace

int Rulers::strip_px() const {
    return static_cast<int>(std::ceil(strip_share * em_px));
}

Rulers rulers_of(const Cylinder& around, double em_px) {
    const double px_per_deg = around.width_px / around.sweep_deg;
    const Steps across = steps_for(px_per_deg, 4.0 * em_px), up = steps_for(px_per_deg, 2.0 * em_px);
    return {across.figures_deg, across.ticks_deg, up.figures_deg, up.ticks_deg, em_px};
}

Result<void> put_rulers(const Rulers& rulers, const Cylinder& around, const TextFace& face,
                        const std::string& left_text, const std::string& right_text, Sheet& sheet) {
    Writer writer(rulers, around, face, sheet);
    writer.level();
    ORO_CHECK(writer.azimuths());
    ORO_CHECK(writer.elevations());
    return writer.tell(left_text, right_text);
}

}  // namespace oro
