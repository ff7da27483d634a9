#include "apps/accuracy/verification.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "apps/drawing/region_scene.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/view/accuracy.h"
#include "core/base/parallel.h"
#include "geo/refined/refined_region.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

// at_least: the names of those that are at least what they say.
ordered_json summary_json(const ErrorSummary& summary) {
    ordered_json json = ordered_json::object(), at_least = ordered_json::array();
    for (const auto& [name, value] : {std::pair{"max", summary.largest},
                                      {"p9999", summary.p9999},
                                      {"p99", summary.p99},
                                      {"mean", summary.mean}}) {
        json[name] = value;
        if (summary.is_at_least(value)) at_least.push_back(name);
    }
    json["at_least"] = at_least;
    return json;
}

// What is said of some only, where there are any.
std::string if_any(std::uint64_t count, const char* words) {
    return count == 0 ? std::string() : "; " + grouped(count) + words;
}

std::string table_line(const char* what, const ErrorSummary& of) {
    constexpr int before_point = 8;
    std::string line = what;
    line.resize(18, ' ');
    for (const double value : {of.largest, of.p9999, of.p99, of.mean}) {
        std::string figure = of.count > 0 ? point_aligned(value, before_point) : "     n/a    ";
        const std::string sign = of.is_at_least(value) ? ">= " : "";
        const std::size_t blanks = std::min(figure.find_first_not_of(' '), sign.size());
        line += figure.replace(figure.find_first_not_of(' ') - blanks, blanks, sign);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

// Meshes as they are drawn, where the true ones would be.
std::vector<TrueMesh> drawn_triangles(const std::vector<PlacedMesh>& meshes, const TrueGround& ground) {
    std::vector<TrueMesh> all;
    for (const PlacedMesh& mesh : meshes)
        all.emplace_back(true_triangles(mesh, ground.surface(0).field().undulation, ground.exaggeration()),
                         static_cast<std::uint32_t>(all.size() + 1), thread_count());
    return all;
}

// Of meshes what stands in the table beside all ground.
std::string mesh_lines(const MeshErrors& meshes) {
    return table_line("  mesh drawn, m", meshes.drawn_m) + table_line("  mesh drawn, px", meshes.drawn_px) +
           table_line("  mesh missed, m", meshes.missed_m) +
           table_line("  mesh missed, px", meshes.missed_px);
}

}  // namespace

Result<Verification> verify_view(const View& view, const TrueScene& truth, const Gpu& gpu, Scene& scene,
                                 RasterPath path, const gpu::FrameStyle& style,
                                 const std::vector<PlacedMesh>* meshes) {
    Verification done;
    DepthPainter painter(gpu, path);
    DepthPictureOptions options;
    options.tau_px = view.tau_px;
    options.model = view.model;
    ORO_TRY(done.picture, painter.draw(scene, view.camera, style, options));
    if (!gpu.validation_messages().empty())
        return Error{ErrorKind::failed, "Vulkan validation", gpu.validation_messages().front()};
    if (!done.picture.settled) return lacks_gpu_memory(scene, "this view");
    const TruePicture true_picture(truth.ground(), truth.sight(), view.camera, thread_count());
    measure(done, true_picture, meshes ? drawn_triangles(*meshes, truth.ground()) : std::vector<TrueMesh>());
    return done;
}

void measure(Verification& done, const TruePicture& truth, std::span<const TrueMesh> drawn) {
    done.true_skyline = truth.skyline();
    done.errors = picture_errors(truth, done.picture.points, done.picture.skylines(), thread_count(), drawn);
    done.slack_px = done.errors.slack_px;
}

void measure_invented(Verification& done, const View& view, const Region& region) {
    const RegionGrid *const detail = detail_of(region), *const data = data_under_detail(region);
    if (detail == nullptr || data == nullptr) return;
    const auto number = static_cast<std::uint32_t>(detail - region.grids.data());
    const double px_a_tangent = 0.5 * view.camera.height_px / view.camera.half_fov_tangent().y;
    InventedGround& found = done.invented.emplace();
    double sum_m2 = 0.0;
    for (const DrawnPoint& point : done.picture.points) {
        if (point.background() || point.grid != number) continue;
        const std::optional<double> off_m = invented_m(*detail, *data, point.row, point.column);
        if (!off_m) continue;
        const double m = view.exaggeration * std::abs(*off_m);
        ++found.pixels;
        sum_m2 += m * m;
        found.largest_m = std::max(found.largest_m, m);
        found.largest_px = std::max(found.largest_px, m / point.z_m * px_a_tangent);
    }
    if (found.pixels > 0) found.rms_m = std::sqrt(sum_m2 / static_cast<double>(found.pixels));
}

namespace {

// How far the ground that was drawn is from the data's, where it is invented.
std::string invented_line(const InventedGround& invented) {
    char line[200];
    std::snprintf(line, sizeof line,
                  "Invented between posts: ground of %s is off the data's surface by %.2f m r.m.s., %.2f m "
                  "at most (%.3g px); the errors above are from the ground with it\n",
                  counted(invented.pixels, "pixel", "pixels").c_str(), invented.rms_m, invented.largest_m,
                  invented.largest_px);
    return line;
}

std::string allowed_line(const Verification& verification, const View& view) {
    char line[160];
    if (view.mesh_level) {
        std::snprintf(line, sizeof line, "Allowed: a level of clusters (--mesh-level %d) promises nothing\n",
                      *view.mesh_level);
        return line;
    }
    std::snprintf(line, sizeof line, "Allowed: %.3g px (--tau %g, and %.2g px that drawing rounds off)\n",
                  view.tau_px + verification.slack_px, view.tau_px, verification.slack_px);
    if (!verification.errors.ground.meshes || view.mesh != "clusters") return line;
    // docs/MESHES.md, "Onto the ground".
    std::string text = line;
    std::snprintf(
        line, sizeof line,
        "A part of a mesh that is left out, as the ground is near enough: %.3g px, as that ground is "
        "drawn within --tau for itself\n",
        2.0 * view.tau_px + verification.slack_px);
    return text + line;
}

}  // namespace

std::string verification_text(const Verification& verification, const View& view,
                              const UnseenGround& unseen) {
    const GroundErrors& ground = verification.errors.ground;
    const SeenErrors& seen = verification.errors.seen;
    const SkylineError& skyline = verification.errors.skyline;
    std::string text =
        "Displacement: how far each pixel's ground is drawn from where it truly is. " +
        counted(ground.drawn, "pixel", "pixels") +
        if_any(ground.beyond_data, " of them where there are no data") +
        (ground.meshes
             ? if_any(ground.between, " of them on meshes, or between grids: from the nearest place of these")
             : if_any(ground.between, " of them between grids, which Seen and Skyline measure, too")) +
        ".\n"
        "Surface: how far the drawn ground is from the true surface, wherever along it.\n"
        "Seen: how far away on the picture the truth has what is drawn; what is missing or should be hidden "
        "counts" +
        if_any(seen.other, " pixels show something else, at an edge") +
        ".\n"
        "Skyline: how far the drawn skyline is from the true one. " +
        (skyline.summary_px.count == 0 ? "None in view"
                                       : counted(skyline.summary_px.count, "column", "columns")) +
        if_any(skyline.in_one_only, " more have one in the picture or in truth alone") + ".\n";
    char line[200];
    std::snprintf(line, sizeof line, "%-18s%9s   %9s   %9s   %9s\n", "error", "largest", "99.99 %", "99 %",
                  "mean");
    text += line;
    text += table_line("  displacement, m", ground.summary_displacement_m) +
            table_line("  displacement, px", ground.summary_displacement_px) +
            table_line("  surface, m", ground.summary_surface_m) +
            table_line("  surface, px", ground.summary_surface_px) +
            (ground.meshes ? mesh_lines(*ground.meshes) : "") + table_line("  seen, px", seen.summary_px) +
            table_line("  skyline, px", skyline.summary_px);
    if (ground.meshes)
        text +=
            "Mesh drawn: how far what is drawn of meshes, or of steps between grids, is from these. Mesh "
            "missed: how far what is truly seen of meshes is from what is drawn, or from the ground.\n";
    text += "99 %: 99 of 100 are off by no more than this.\n";
    if (ground.summary_displacement_px.at_least + ground.summary_surface_px.at_least +
            seen.summary_px.at_least >
        0)
        text += ">=: at least this. Nothing like it is seen within " + std::to_string(seen_reach_px) +
                " px (seen), or its place is beside or behind the eye (displacement, surface).\n";
    text += allowed_line(verification, view);
    if (verification.invented) text += invented_line(*verification.invented);
    if (const std::string beyond = unseen_sentence(unseen); !beyond.empty())
        text += "Where the data end: " + beyond + "\n";
    return text;
}

ordered_json verification_json(const Verification& verification) {
    const GroundErrors& ground = verification.errors.ground;
    const SeenErrors& seen = verification.errors.seen;
    const SkylineError& skyline = verification.errors.skyline;
    ordered_json json = ordered_json::object();
    json["displacement_m"] = summary_json(ground.summary_displacement_m);
    json["displacement_px"] = summary_json(ground.summary_displacement_px);
    json["surface_m"] = summary_json(ground.summary_surface_m);
    json["surface_px"] = summary_json(ground.summary_surface_px);
    if (const auto& meshes = ground.meshes)
        json["meshes"] = json_object(
            "drawn_m", summary_json(meshes->drawn_m), "drawn_px", summary_json(meshes->drawn_px), "missed_m",
            summary_json(meshes->missed_m), "missed_px", summary_json(meshes->missed_px));
    json["seen_px"] = summary_json(seen.summary_px);
    json["skyline_px"] = summary_json(skyline.summary_px);
    json["largest_px"] = verification.errors.largest_px();
    json["largest_px_at_least"] = verification.errors.largest_px_at_least();
    json["slack_px"] = verification.slack_px;
    if (const auto& invented = verification.invented)
        json["invented"] = json_object("pixels", invented->pixels, "rms_m", invented->rms_m, "max_m",
                                       invented->largest_m, "max_px", invented->largest_px);
    json["drawn_pixels"] = ground.drawn;
    json["pixels_beyond_data"] = ground.beyond_data;
    if (ground.between > 0) json["pixels_between_grids"] = ground.between;
    json["pixels_of_other_ground"] = seen.other;
    json["skyline_columns"] = skyline.summary_px.count;
    json["skyline_in_one_only"] = skyline.in_one_only;
    return json;
}

}  // namespace oro
