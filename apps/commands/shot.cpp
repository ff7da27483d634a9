// orograph shot: from files to a picture that knows where it was taken from.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include "apps/accuracy/accuracy.h"
#include "apps/accuracy/verification.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/shot_json.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/region_scene.h"
#include "apps/output/overwrite_guard.h"
#include "apps/output/picture_file.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "apps/view/view_changes.h"
#include "apps/window/picking.h"
#include "core/base/elapsed.h"
#include "core/base/file_there.h"
#include "core/base/open_file.h"
#include "core/lod/ground_means.h"
#include "core/terrain/ground.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// Without --out a view goes back to the picture that it came from.
Result<PictureFiles> shot_files(const ShotOptions& options) {
    if (options.out.empty() && options.view_file.empty())
        return refused("--out", "", "is missing: name the picture to write (.png, .jpg or .tif)");
    std::string out = options.out.empty() ? options.view_file : options.out;
    if (options.out.empty() && fs::path(out).extension() == ".json") {
        for (const char* ending : {".png", ".jpg", ".jpeg", ".tif", ".tiff"}) {
            out = fs::path(options.view_file).replace_extension(ending).string();
            ORO_TRY(const bool there, is_there(out));
            if (there) break;
            out = fs::path(options.view_file).replace_extension(".png").string();
        }
    }
    if (const auto format = picture_format(out); !format.ok())
        return refused(options.out.empty() ? "--view" : "--out", out, format.error().what);
    return picture_files(out);
}

// A picture drawn again from its own view: drawn without a name and compared, so that nothing is replaced.
bool is_check(const ShotOptions& options, const PictureFiles& files) {
    std::error_code ignored;
    return options.out.empty() && !options.overwrite && fs::is_regular_file(files.picture, ignored);
}

void say_notes(const ShotOptions& options, const ShotResult& shot) {
    say_notes(shot.region, options.quiet);
    if (const std::string note = note_of_year(shot.view.sun); !note.empty()) say(options.quiet, note);
    if (shot.view.vectors_read) say_vectors(*shot.view.vectors_read, shot.view.vectors, options.quiet);
    const Geodetic& eye = shot.view.camera.eye;
    const auto ground = ground_h_m(shot.region.field, eye.lat_deg, eye.lon_deg, shot.view.exaggeration);
    if (ground && eye.h_m < *ground) {
        char text[80];
        std::snprintf(text, sizeof text, "note: the eye is %.1f m below the ground", *ground - eye.h_m);
        say(options.quiet, text);
    }
}

std::vector<std::string> written_files(const ShotOptions& options, const PictureFiles& files) {
    std::vector<std::string> all;
    if (!is_check(options, files)) all.push_back(files.picture);
    if (options.verify) all.push_back(files.error);
    return all;
}

// Before anything takes time: that all files can be written where they shall be.
Result<void> check_out(const ShotOptions& options, const PictureFiles& files) {
    for (const std::string& file : written_files(options, files)) {
        if (!options.overwrite && access(file.c_str(), F_OK) == 0)
            return Error{ErrorKind::failed, file, "is there already (--overwrite replaces it)"};
        if (const auto trial = WholeFile::create(file, options.overwrite); !trial.ok()) return trial.error();
    }
    return {};
}

// Measures what was drawn, the same way, and makes the picture of its errors, which has no name yet.
Result<WholeFile> verify_shot(const ShotOptions& options, const PictureFiles& files, const Gpu& gpu,
                              Scene& scene, const Style& style, ShotResult& shot) {
    const auto start = Clock::now();
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(shot.view, shot.region));
    ORO_TRY(shot.verification, verify_view(shot.view, *truth, gpu, scene, shot.picture.path, style.frame));
    ORO_TRY(const std::vector<std::uint8_t> png,
            error_picture_png(*shot.verification, shot.view.tau_px, ErrorPanels::four));
    ORO_TRY(WholeFile file, WholeFile::create(files.error, options.overwrite));
    ORO_CHECK(file.write(png.data(), png.size()));
    shot.times.verify_s = seconds_since(start);
    return file;
}

// Where a picture that is only compared would be, if it ever got a name.
PictureFiles unnamed(const PictureFiles& files) {
    std::error_code failed;
    const fs::path folder = fs::temp_directory_path(failed);
    PictureFiles other = files;
    other.picture =
        ((failed ? fs::path("/tmp") : folder) / ("orograph-check-" + std::to_string(getpid()))).string() +
        fs::path(files.picture).extension().string();
    return other;
}

// True when a drawn picture has the bytes of a file.
Result<bool> is_same(WholeFile& drawn, const std::string& path) {
    ORO_TRY(const OpenFile other, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(std::uint64_t left, other.size());
    std::FILE* const stream = drawn.stream();
    if (std::fseek(stream, 0, SEEK_END) != 0 || static_cast<std::uint64_t>(ftello(stream)) != left)
        return false;
    std::rewind(stream);
    std::vector<std::byte> ours(1 << 16), theirs(ours.size());
    for (std::uint64_t at = 0; left > 0;) {
        const std::size_t count = std::min<std::uint64_t>(left, ours.size());
        ORO_CHECK(other.read(at, std::span(theirs).first(count)));
        if (std::fread(ours.data(), 1, count, stream) != count ||
            !std::equal(ours.begin(), ours.begin() + static_cast<std::ptrdiff_t>(count), theirs.begin()))
            return false;
        at += count;
        left -= count;
    }
    return true;
}

// Gives what was drawn its names, or compares it with the picture that is there. Tags that tell less than
// today's, or of another version of the program, do not make it another picture.
Result<void> finish_shot(const ShotOptions& options, const PictureFiles& files, ShotResult& shot,
                         WholeFile picture, std::optional<WholeFile> errors) {
    if (!is_check(options, files)) return errors ? commit_together({&*errors, &picture}) : picture.commit();
    if (errors) ORO_CHECK(errors->commit());
    ORO_TRY(shot.same_bytes, is_same(picture, files.picture));
    const std::optional<Fingerprints>& told = shot.view.told->prints;
    const bool same_pixels = shot.beside && shot.beside->any.count == 0;
    if (shot.same_bytes || (same_pixels && (!told || told->program != program_print()))) return {};
    const std::string where = same_pixels || !shot.beside
                                  ? ""
                                  : ": " + pixels_words(shot.beside->any, shot.beside->pixels) + " differ";
    return Error{ErrorKind::failed, files.picture,
                 "is not what its view draws now" + where +
                     "; left as it is (--overwrite replaces it, --out writes another)"};
}

// The cheapest bundle that keeps the view within the tolerance; single options of the command line win over
// it.
Result<void> choose_bundle(const ShotOptions& options, const RegionPages& pages, ShotResult& shot) {
    ORO_TRY(const double tolerance_px, parse_tolerance(*options.view.tolerance));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(shot.view, shot.region));
    FixedAccuracy fixed;
    if (options.view.tau_px) fixed.tau_px = shot.view.tau_px;
    if (options.view.heights) fixed.heights = shot.view.heights;
    if (options.view.refraction_k || options.view.air) fixed.air = shot.view.model.air;
    ORO_TRY(shot.choice,
            choose_accuracy(shot.view, shot.region, truth->surface(), pages, tolerance_px, fixed));
    apply_bundle(shot.choice->bundle, shot.view);
    forget_other_bundle(shot.view);
    const std::string& chosen = shot.view.accuracy.empty() ? shot.choice->bundle.options : shot.view.accuracy;
    char text[240];
    std::snprintf(text, sizeof text, "accuracy: %s, predicted error %.3g px%s", chosen.c_str(),
                  shot.choice->predicted_px,
                  shot.choice->holds ? "" : ": more than the tolerance, and nothing here comes nearer");
    say(options.quiet, text);
    return {};
}

// What was drawn and measured.
void tell(const ShotOptions& options, const PictureFiles& files, bool checks, const ShotResult& shot,
          const Gpu& gpu, const Style& style) {
    if (!checks) say(options.quiet, "wrote " + files.picture);
    // Measurements say it themselves.
    if (!shot.verification && shot.unseen.columns_beyond > 0)
        say(options.quiet, "note: " + unseen_sentence(shot.unseen));
    if (shot.verification) {
        say(options.quiet, "wrote " + files.error);
        // What was asked for: as a table, or with -q as JSON alone.
        if (!options.quiet || !options.json)
            std::fputs((verification_text(*shot.verification, shot.view.tau_px, shot.unseen) +
                        light_line(shot.view, shot.region))
                           .c_str(),
                       stderr);
    }
    if (options.json) std::printf("%s\n", json_text(shot_json(shot, files, gpu, style), true).c_str());
}

// Reads a picture's pixels along while it is drawn again. What cannot be read is not compared: the bytes tell
// that it is another.
class BesidePicture {
  public:
    BesidePicture(const std::string& file, const Camera& camera) {
        if (file.empty()) return;
        auto opened = PictureComparison::open(file, camera.width_px, camera.height_px, device_slack);
        if (opened.ok()) comparison_.emplace(std::move(*opened));
    }
    void take(std::span<const std::uint8_t> row) {
        if (comparison_ && !comparison_->add_drawn_row(row).ok()) comparison_.reset();
    }
    std::optional<PictureDifference> found() {
        if (!comparison_) return std::nullopt;
        const auto found = comparison_->finish();
        return found.ok() ? std::optional(*found) : std::nullopt;
    }

  private:
    std::optional<PictureComparison> comparison_;
};

// Plans and draws; nothing is written when nothing of the region can be in view.
Result<DrawnPicture> draw_shot(const ShotOptions& options, const PictureFiles& files, const Gpu& gpu,
                               Scene& scene, const Style& style, ProgressBar& bar, ShotResult& shot) {
    const auto drawing = Clock::now();
    const Camera& camera = shot.view.camera;
    ORO_TRY(const FramePlan first, scene.plan(camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}},
                                              shot.view.tau_px, shot.view.model));
    // Before anything is written. A page that may be in view, and then is not, is told of when it is drawn.
    const auto nothing = nothing_in_view(shot.view, shot.region, options.view_file);
    if (first.pages_wanted == 0 && !nothing.ok()) return nothing.error();
    ORO_TRY(shot.middle, place_in_middle(shot.view, shot.region));
    const bool checks = is_check(options, files);
    BesidePicture beside(checks ? files.picture : "", camera);
    ORO_TRY(DrawnPicture picture,
            draw_picture(
                checks ? unnamed(files) : files, options.overwrite || checks, shot.view, shot.region,
                shot.middle, gpu, scene, style, [&](double share) { bar.show(share, "drawing"); },
                [&](std::span<const std::uint8_t> row) { return beside.take(row), Result<void>(); }));
    shot.beside = beside.found();
    shot.picture = picture.report;
    shot.labels = picture.labels;
    shot.names = picture.names;
    shot.overlay = picture.overlay;
    for (const std::string& note : notes_of(shot.names)) say(options.quiet, "note: " + note);
    shot.view.prints = picture.prints;
    shot.times.draw_s = seconds_since(drawing);
    if (shot.picture.ground_px == 0)
        say(options.quiet, "note: " + (nothing.ok() ? *nothing : nothing.error().what));
    shot.pages_on_gpu = scene.store().size();
    shot.page_bytes = scene.store().bytes();
    shot.height_step_m = scene.height_step_m();
    return picture;
}

Result<void> take_shot(const ShotOptions& options, const PictureFiles& files) {
    ORO_CHECK(check_out(options, files));
    ORO_TRY(const double ceiling_m, unseen_ceiling(options.unseen_ceiling_m));
    if (options.view.tolerance) {
        if (options.view.accuracy)
            return refused("--tolerance", "", either_words("--tolerance", "--accuracy"));
        ORO_CHECK(parse_tolerance(*options.view.tolerance));
    }
    ProgressBar bar(options.quiet);
    ShotResult shot;
    const auto reading = Clock::now();
    ORO_CHECK(open_view(
        options.view_file, options.view, options.region,
        [&](double share, const std::string& what) { bar.show(share, "reading " + what); }, shot.view,
        shot.region));
    ORO_CHECK(check_unchanged(shot.view, shot.region, options.data_changed, options.quiet));
    if (options.no_paths) shot.view.tells_paths = false;
    if (!is_check(options, files)) say_edited(shot.view, options.quiet);
    shot.times.read_s = seconds_since(reading);
    ORO_CHECK(spare_inputs(written_files(options, files), shot.view, shot.region));
    ORO_TRY(const Style style, load_style(shot.view, shot.region.field));
    bar.clear();
    say_notes(options, shot);

    ORO_TRY(const std::unique_ptr<Gpu> gpu, Gpu::create(gpu_options_from_environment()));
    const auto start = Clock::now();
    ORO_TRY(std::unique_ptr<RegionPages> pages,
            region_pages(shot.region, shot.view.exaggeration,
                         [&](double share) { bar.show(share, "measuring levels"); }));
    if (options.view.tolerance) ORO_CHECK(choose_bundle(options, *pages, shot));
    ORO_TRY(shot.unseen, unseen_in(shot.view, shot.region, ceiling_m));
    ORO_TRY(Scene scene, create_scene(*gpu, std::move(pages), memory_of_pages(shot.view, options.memory),
                                      shot.view.heights, asks_for_means(style.frame)));
    if (const std::string note = note_of_means(style.frame, scene.pages()); !note.empty())
        say(options.quiet, note);
    shot.has_means = asks_for_means(style.frame) && scene.pages().knows_means();
    ORO_CHECK(lay_images(shot.view, shot.region, options.memory, *gpu, scene, options.quiet));
    const PageLayout finest = scene.pages().layout(0);
    shot.pages = static_cast<std::uint64_t>(finest.rows) * static_cast<std::uint64_t>(finest.columns);
    shot.triangles_at_full_resolution = scene.pages().facts().triangles;
    shot.times.pages_s = seconds_since(start);
    ORO_TRY(DrawnPicture picture, draw_shot(options, files, *gpu, scene, style, bar, shot));
    const bool checks = is_check(options, files);
    std::optional<WholeFile> errors;
    if (options.verify) {
        bar.show(1.0, "measuring errors");
        ORO_TRY(errors, verify_shot(options, files, *gpu, scene, style, shot));
    }
    bar.clear();
    const Result<void> finished =
        finish_shot(options, files, shot, std::move(picture.file), std::move(errors));
    if (finished.ok() || checks) tell(options, files, checks, shot, *gpu, style);
    if (finished.ok() && checks)
        say(options.quiet, files.picture + " is there already, and its view draws the same " +
                               (shot.same_bytes ? "bytes" : "pixels"));
    return finished;
}

}  // namespace

Result<void> run_shot(const ShotOptions& options) {
    ORO_TRY(const PictureFiles files, shot_files(options));
    return take_shot(options, files);
}

}  // namespace oro
