// The picture of errors: colours by size, and what the colours mean.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "apps/accuracy/verification.h"
#include "apps/report/canvas.h"
#include "apps/report/figures.h"
#include "geo/pictures/png_bytes.h"

namespace oro {
namespace {

constexpr Rgb paper{255, 255, 255}, ink{20, 20, 20}, sky{190, 190, 190};
constexpr Rgb unmeasured{255, 0, 255}, unmeasured_gap{90, 0, 90}, tau_mark{255, 90, 0};
constexpr Rgb plain_ground{225, 220, 210};
constexpr int least_width_px = 320;

// Dark to light throughout, and told apart by all kinds of colour vision. Source: viridis, S. van der Walt,
// N. Smith, 2015 (CC0), at every eighth.
constexpr std::array<Rgb, 9> ramp{Rgb{68, 1, 84},    Rgb{71, 45, 123},  Rgb{59, 82, 139},
                                  Rgb{44, 114, 142}, Rgb{33, 145, 140}, Rgb{40, 174, 128},
                                  Rgb{94, 201, 98},  Rgb{173, 220, 48}, Rgb{253, 231, 37}};

Rgb ramp_at(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (ramp.size() - 1);
    const std::size_t from = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
    Rgb colour{};
    for (std::size_t i = 0; i < colour.size(); ++i)
        colour[i] = static_cast<std::uint8_t>(
            std::lround(std::lerp(ramp[from][i], ramp[from + 1][i], place - static_cast<double>(from))));
    return colour;
}

// 0 at the scale's beginning, 1 at its end; errors of 0 lie before it.
double scale_share(double error_px) {
    if (error_px <= 0.0) return 0.0;
    return std::log10(error_px / error_scale_from_px) / std::log10(error_scale_to_px / error_scale_from_px);
}

bool is_on_scale(double error_px) {
    return error_px >= error_scale_from_px && error_px <= error_scale_to_px;
}

// A picture of one measure, at a place of the canvas.
struct Panel {
    const char* name;
    int left, top;
};

void set_error(Canvas& canvas, int x, int y, bool ground, float error_px) {
    if (error_px != not_measured)
        canvas.set(x, y, ramp_at(scale_share(static_cast<double>(error_px))));
    else if (ground)
        canvas.set(x, y, (x + y) % 4 < 2 ? unmeasured : unmeasured_gap);
    else
        canvas.set(x, y, sky);
}

// Of the measures that each pixel has.
void draw_errors(Canvas& canvas, const Panel& panel, const DepthPicture& picture,
                 const std::vector<float>& errors_px) {
    std::size_t pixel = 0;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x, ++pixel)
            set_error(canvas, panel.left + x, panel.top + y, picture.depths[pixel] > 0.0F, errors_px[pixel]);
    }
}

// The true skyline as a band in the colour of its error, upwards from it; downwards where there is no room.
void draw_skyline(Canvas& canvas, const Panel& panel, const Verification& verification, int scale) {
    const DepthPicture& picture = verification.picture;
    std::size_t pixel = 0;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x, ++pixel)
            canvas.set(panel.left + x, panel.top + y, picture.depths[pixel] > 0.0F ? plain_ground : sky);
    }
    const int band_px = 8 * scale;
    for (int x = 0; x < picture.width_px; ++x) {
        const float error_px = verification.errors.skyline.px[static_cast<std::size_t>(x)];
        const float true_px = verification.true_skyline.y_px[static_cast<std::size_t>(x)];
        if (error_px == not_measured || true_px == not_measured) continue;
        const int y = std::min(static_cast<int>(true_px), picture.height_px - 1);
        const int top = y >= band_px ? y - band_px : y;
        canvas.fill(panel.left + x, panel.top + top, 1, std::min(band_px, picture.height_px - top),
                    ramp_at(scale_share(static_cast<double>(error_px))));
    }
}

void write_name(Canvas& canvas, const Panel& panel, int scale) {
    canvas.fill(panel.left, panel.top, Canvas::text_width_px(panel.name, scale) + 8 * scale,
                (Canvas::text_height_dots + 4) * scale, paper);
    canvas.write(panel.left + 4 * scale, panel.top + 3 * scale, panel.name, ink, scale);
}

// No exponents: what is finer than a thousandth is "<0.001".
std::string figures_line(const char* what, const ErrorSummary& of) {
    std::string line = what;
    line.resize(12, ' ');
    for (const double value : {of.largest, of.p9999, of.p99, of.mean}) {
        std::string text = of.count == 0 ? "n/a" : value < 1.0e6 ? coarse_figure(value) : ">999,999";
        if (of.count > 0 && value < 1.0e6 && of.is_at_least(value)) text = ">=" + text;
        line += std::string(text.size() < 10 ? 10 - text.size() : 0, ' ') + text;
    }
    return line;
}

constexpr int line_dots = 11, margin_dots = 6, bar_dots = 10;
constexpr int legend_dots = 2 * margin_dots + bar_dots + 8 + 10 * line_dots;

// The scale with its ticks and tau.
void draw_scale(Canvas& canvas, int top, double tau_px, int scale) {
    const int left = margin_dots * scale, width = (least_width_px - 60) * scale;
    for (int x = 0; x < width; ++x)
        canvas.fill(left + x, top, 1, bar_dots * scale, ramp_at(static_cast<double>(x) / (width - 1)));
    const auto place = [&](double error_px) {
        return left + static_cast<int>(std::lround(scale_share(error_px) * (width - 1)));
    };
    for (const auto& [error_px, label] :
         {std::pair{0.001, "0.001"}, {0.01, "0.01"}, {0.1, "0.1"}, {1.0, "1"}, {10.0, "10 px or more"}}) {
        const int x = place(error_px);
        canvas.fill(x, top + bar_dots * scale, scale, 2 * scale, ink);
        const int text_left = std::max(left, x - Canvas::text_width_px(label, scale) / 2);
        canvas.write(text_left, top + (bar_dots + 4) * scale, label, ink, scale);
    }
    if (is_on_scale(tau_px))
        canvas.fill(place(tau_px), top - 3 * scale, scale, (bar_dots + 3) * scale, tau_mark);
}

void draw_legend(Canvas& canvas, const Verification& verification, double tau_px, int top, int scale) {
    const std::vector<std::string> lines = error_legend(verification, tau_px);
    int y = top + margin_dots * scale;
    const auto write = [&](const std::string& line) {
        canvas.write(margin_dots * scale, y, line, ink, scale);
        y += line_dots * scale;
    };
    write(lines.front());
    y += 3 * scale;
    draw_scale(canvas, y, tau_px, scale);
    y += (bar_dots + 5 + line_dots) * scale;
    for (std::size_t i = 1; i < lines.size(); ++i) write(lines[i]);
}

// The four measures, a picture each, two beside two; or the displacement alone.
Canvas error_canvas(const Verification& verification, double tau_px, ErrorPanels panels) {
    const DepthPicture& picture = verification.picture;
    const int scale = std::clamp(picture.width_px / (3 * least_width_px / 2), 1, 8);
    const int gap_px = 2 * scale, count = panels == ErrorPanels::four ? 2 : 1;
    const int width_px = count * picture.width_px + (count - 1) * gap_px;
    const int height_px = count * picture.height_px + (count - 1) * gap_px;
    Canvas canvas(std::max(width_px, least_width_px * scale), height_px + legend_dots * scale, paper);
    const PictureErrors& errors = verification.errors;
    const Panel displacement{"displacement", 0, 0};
    draw_errors(canvas, displacement, picture, errors.ground.displacement_px);
    if (panels == ErrorPanels::four) {
        const int right = picture.width_px + gap_px, below = picture.height_px + gap_px;
        const Panel surface{"surface", right, 0}, seen{"seen", 0, below}, skyline{"skyline", right, below};
        draw_errors(canvas, surface, picture, errors.ground.surface_px);
        draw_errors(canvas, seen, picture, errors.seen.px);
        draw_skyline(canvas, skyline, verification, scale);
        for (const Panel& panel : {displacement, surface, seen, skyline}) write_name(canvas, panel, scale);
    }
    draw_legend(canvas, verification, tau_px, height_px, scale);
    return canvas;
}

}  // namespace

std::vector<std::string> error_legend(const Verification& verification, double tau_px) {
    char tau[80], heads[80];
    const bool tiny = tau_px > 0.0 && tau_px < error_scale_from_px;
    std::snprintf(tau, sizeof tau, "%stau %s%g px", is_on_scale(tau_px) ? "line: " : "",
                  tiny ? "less than " : "", tiny ? error_scale_from_px : tau_px);
    std::snprintf(heads, sizeof heads, "%-12s%10s%10s%10s%10s", "", "largest", "99.99 %", "99 %", "mean");
    const PictureErrors& errors = verification.errors;
    return {"colour: how far off, in pixels (px)",
            tau,
            heads,
            figures_line("displacement", errors.ground.summary_displacement_px),
            figures_line("surface", errors.ground.summary_surface_px),
            figures_line("seen", errors.seen.summary_px),
            figures_line("skyline", errors.skyline.summary_px),
            figures_line("displaced, m", errors.ground.summary_displacement_m),
            "grey: sky, magenta: could not be measured"};
}

Result<std::vector<std::uint8_t>> error_picture_png(const Verification& verification, double tau_px,
                                                    ErrorPanels panels) {
    const Canvas canvas = error_canvas(verification, tau_px, panels);
    return png_bytes(canvas.rgb(), canvas.width_px(), canvas.height_px());
}

Result<void> write_error_picture(const std::string& path, const Verification& verification, double tau_px,
                                 bool overwrite) {
    const Canvas canvas = error_canvas(verification, tau_px, ErrorPanels::four);
    return write_png(path, canvas.rgb(), canvas.width_px(), canvas.height_px(), overwrite);
}

}  // namespace oro
