#include "apps/accuracy/verification.h"

#include <cstdio>

#include "apps/accuracy/accuracy.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

ordered_json summary_json(const ErrorSummary& summary) {
    return json_object("max", summary.largest, "p9999", summary.p9999, "p99", summary.p99, "mean",
                       summary.mean);
}

// What is said of some only, where there are any.
std::string if_any(std::uint64_t count, const char* words) {
    return count == 0 ? std::string() : "; " + grouped(count) + words;
}

std::string table_line(const char* what, const ErrorSummary& of) {
    constexpr int before_point = 8;
    std::string line = what;
    line.resize(14, ' ');
    for (const double value : {of.largest, of.p9999, of.p99, of.mean})
        line += of.count > 0 ? point_aligned(value, before_point) : "     n/a    ";
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
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

std::string verification_text(const Verification& verification, double tau_px, const UnseenGround& unseen) {
    const InteriorError& interior = verification.interior;
    const SkylineError& skyline = verification.skyline;
    char text[400];
    std::snprintf(
        text, sizeof text,
        "Ground: how far each drawn point is from the true ground at its latitude and longitude, in height "
        "(m) and on the picture (px). %s%s.\n"
        "Skyline: how far the drawn skyline is from the true one. %s%s.\n",
        counted(interior.drawn, "pixel", "pixels").c_str(),
        if_any(interior.beyond_data, " of them where there are no data").c_str(),
        skyline.summary_px.count == 0 ? "None in view"
                                      : counted(skyline.summary_px.count, "column", "columns").c_str(),
        if_any(skyline.in_one_only, " more have one in the picture or in truth alone").c_str());
    std::string all = text;
    char head[120];
    std::snprintf(head, sizeof head, "%-14s%9s   %9s   %9s   %9s\n", "error", "largest", "99.99 %", "99 %",
                  "mean");
    all += head;
    all += table_line("  ground, m", interior.summary_m) + table_line("  ground, px", interior.summary_px) +
           table_line("  skyline, px", skyline.summary_px);
    std::snprintf(text, sizeof text,
                  "99 %%: 99 of 100 are off by no more than this.\n"
                  "Allowed: %g px (--tau %g, and %g px that drawing rounds off)\n",
                  tau_px + drawing_slack_px, tau_px, drawing_slack_px);
    all += text;
    if (unseen.columns_beyond > 0) all += "Where the data end: " + unseen_sentence(unseen) + "\n";
    return all;
}

ordered_json verification_json(const Verification& verification) {
    const InteriorError& interior = verification.interior;
    const SkylineError& skyline = verification.skyline;
    ordered_json json = ordered_json::object();
    json["interior_m"] = summary_json(interior.summary_m);
    json["interior_px"] = summary_json(interior.summary_px);
    json["skyline_px"] = summary_json(skyline.summary_px);
    json["drawn_pixels"] = interior.drawn;
    json["pixels_beyond_data"] = interior.beyond_data;
    json["skyline_columns"] = skyline.summary_px.count;
    json["skyline_in_one_only"] = skyline.in_one_only;
    return json;
}

}  // namespace oro
