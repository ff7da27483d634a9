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
constexpr Rgb unmeasured{255, 0, 255}, unmeasured_gap{90, 0, 90}, skyline_mark{255, 90, 0};
constexpr float marked_from_px = 0.5F;
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

void draw_errors(Canvas& canvas, const Verification& verification) {
    const DepthPicture& picture = verification.picture;
    std::size_t pixel = 0;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x, ++pixel) {
            const float error_px = verification.errors.ground.displacement_px[pixel];
            if (!(picture.depths[pixel] > 0.0F))
                canvas.set(x, y, sky);
            else if (error_px == not_measured)
                canvas.set(x, y, (x + y) % 4 < 2 ? unmeasured : unmeasured_gap);
            else
                canvas.set(x, y, ramp_at(scale_share(static_cast<double>(error_px))));
        }
    }
}

// Above the true skyline; below it where there is no room.
void mark_skyline(Canvas& canvas, const Verification& verification, int scale) {
    const int mark_px = 8 * scale;
    for (int x = 0; x < verification.picture.width_px; ++x) {
        const float error_px = verification.errors.skyline.px[static_cast<std::size_t>(x)];
        if (error_px == not_measured || error_px <= marked_from_px) continue;
        const int y = static_cast<int>(verification.true_skyline.y_px[static_cast<std::size_t>(x)]);
        const int top = y >= mark_px ? y - mark_px : y;
        canvas.fill(x, top, 1, std::min(mark_px, verification.picture.height_px - top), skyline_mark);
    }
}

// No exponents: what is finer than a thousandth is "<0.001".
std::string figures_line(const char* what, const ErrorSummary& of) {
    std::string line = what;
    line.resize(11, ' ');
    for (const double value : {of.largest, of.p9999, of.p99, of.mean}) {
        const std::string text = of.count == 0 ? "n/a" : value < 1.0e6 ? coarse_figure(value) : ">999,999";
        line += std::string(text.size() < 10 ? 10 - text.size() : 0, ' ') + text;
    }
    return line;
}

constexpr int line_dots = 11, margin_dots = 6, bar_dots = 10;
constexpr int legend_dots = 2 * margin_dots + bar_dots + 8 + 9 * line_dots;

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
        canvas.fill(place(tau_px), top - 3 * scale, scale, (bar_dots + 3) * scale, skyline_mark);
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

Canvas error_canvas(const Verification& verification, double tau_px) {
    const DepthPicture& picture = verification.picture;
    const int scale = std::clamp(picture.width_px / (3 * least_width_px / 2), 1, 8);
    Canvas canvas(std::max(picture.width_px, least_width_px * scale), picture.height_px + legend_dots * scale,
                  paper);
    draw_errors(canvas, verification);
    mark_skyline(canvas, verification, scale);
    draw_legend(canvas, verification, tau_px, picture.height_px, scale);
    return canvas;
}

}  // namespace

std::vector<std::string> error_legend(const Verification& verification, double tau_px) {
    char tau[80], heads[80], skyline[80];
    const bool tiny = tau_px > 0.0 && tau_px < error_scale_from_px;
    std::snprintf(tau, sizeof tau, "%stau %s%g px", is_on_scale(tau_px) ? "line: " : "",
                  tiny ? "less than " : "", tiny ? error_scale_from_px : tau_px);
    std::snprintf(heads, sizeof heads, "%-11s%10s%10s%10s%10s", "", "largest", "99.99 %", "99 %", "mean");
    std::snprintf(skyline, sizeof skyline, "orange: skyline off by more than %g px",
                  static_cast<double>(marked_from_px));
    return {"colour: how far off the ground is, in pixels (px)",
            tau,
            heads,
            figures_line("ground, px", verification.errors.ground.summary_displacement_px),
            figures_line("ground, m", verification.errors.ground.summary_displacement_m),
            figures_line("skyline, px", verification.errors.skyline.summary_px),
            skyline,
            "grey: sky, magenta: could not be measured"};
}

Result<std::vector<std::uint8_t>> error_picture_png(const Verification& verification, double tau_px) {
    const Canvas canvas = error_canvas(verification, tau_px);
    return png_bytes(canvas.rgb(), canvas.width_px(), canvas.height_px());
}

Result<void> write_error_picture(const std::string& path, const Verification& verification, double tau_px,
                                 bool overwrite) {
    const Canvas canvas = error_canvas(verification, tau_px);
    return write_png(path, canvas.rgb(), canvas.width_px(), canvas.height_px(), overwrite);
}

}  // namespace oro
