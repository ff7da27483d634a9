#include "apps/verification.h"

#include <cstdio>

#include "core/parallel.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json summary_json(const ErrorSummary& summary) {
    return {{"max", summary.largest}, {"p9999", summary.p9999}, {"p99", summary.p99}, {"mean", summary.mean}};
}

std::string table_line(const char* what, const ErrorSummary& of) {
    char line[120];
    std::snprintf(line, sizeof line, "  %-13s %12.6f %12.6f %12.6f %12.6f\n", what, of.largest, of.p9999,
                  of.p99, of.mean);
    return line;
}

}  // namespace

Result<Verification> verify_view(const View& view, const TrueScene& truth, const Gpu& gpu, Scene& scene,
                                 RasterPath path, const gpu::FrameStyle& style) {
    Verification done;
    DepthPainter painter(gpu, path);
    DepthPictureOptions options;
    options.tau_px = view.tau_px;
    options.model = view.model;
    ORO_TRY(done.picture, painter.draw(scene, view.camera, style, options));
    if (!gpu.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu.validation_messages().front()};
    if (!done.picture.settled)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "the GPU may hold " + std::to_string(scene.store().capacity()) +
                         " pages of terrain; this view needs more (a larger --tau needs fewer)"};
    const int threads = thread_count();
    done.interior =
        interior_error(truth.surface(), truth.sight(), view.camera, done.picture.centres(), threads);
    done.true_skyline = true_skyline(truth.surface(), truth.sight(), view.camera, threads);
    done.skyline = skyline_error(done.true_skyline, view.camera, done.picture.skylines());
    return done;
}

std::string verification_text(const Verification& verification, double tau_px) {
    const InteriorError& interior = verification.interior;
    const SkylineError& skyline = verification.skyline;
    char text[320];
    std::snprintf(text, sizeof text, "%-15s %12s %12s %12s %12s\n", "error", "largest", "99.99 %", "99 %",
                  "mean");
    std::string all = text;
    all += table_line("interior, m", interior.summary_m) + table_line("interior, px", interior.summary_px) +
           table_line("skyline, px", skyline.summary_px);
    std::snprintf(text, sizeof text,
                  "  of %llu pixels of ground (%llu over no data) and %llu columns with a skyline (%llu more "
                  "in one of picture and truth only); tau %g px\n",
                  static_cast<unsigned long long>(interior.drawn),
                  static_cast<unsigned long long>(interior.beyond_data),
                  static_cast<unsigned long long>(skyline.summary_px.count),
                  static_cast<unsigned long long>(skyline.in_one_only), tau_px);
    return all + text;
}

ordered_json verification_json(const Verification& verification) {
    const InteriorError& interior = verification.interior;
    const SkylineError& skyline = verification.skyline;
    return {
        {"interior_m", summary_json(interior.summary_m)}, {"interior_px", summary_json(interior.summary_px)},
        {"skyline_px", summary_json(skyline.summary_px)}, {"drawn_pixels", interior.drawn},
        {"pixels_beyond_data", interior.beyond_data},     {"skyline_columns", skyline.summary_px.count},
        {"skyline_in_one_only", skyline.in_one_only}};
}

}  // namespace oro
