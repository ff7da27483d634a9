// The calls of the library that draw: shot and panorama.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/command_line.h"
#include "apps/commands/coordinates.h"
#include "apps/commands/named_places.h"
#include "apps/commands/panorama/panorama_asked.h"
#include "apps/commands/parsed_line.h"
#include "apps/commands/shot/shot_scene.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/labels/labelled_picture.h"
#include "apps/layers/picture_layers.h"
#include "apps/legend/legend.h"
#include "apps/library/guarded_call.h"
#include "apps/library/library_structures.h"
#include "apps/library/open_regions.h"
#include "apps/library/orograph.h"
#include "apps/maps/labelled_map.h"
#include "apps/options/region_option_table.h"
#include "apps/view/view_in_region.h"

namespace {

using oro::OpenRegion;
using oro::Result;

// Where a caller wants a picture, and what it learns of it.
class PictureBuffer {
  public:
    PictureBuffer(std::uint8_t* rgba, std::size_t capacity, std::size_t* width_px, std::size_t* height_px)
        : rgba_(rgba), capacity_(capacity), width_px_(width_px), height_px_(height_px) {}

    // Before anything is drawn. Throws TooSmall.
    Result<void> begin(int width_px, int height_px) {
        *width_px_ = static_cast<std::size_t>(width_px);
        *height_px_ = static_cast<std::size_t>(height_px);
        const std::size_t bytes = 4 * *width_px_ * *height_px_;
        if (capacity_ < bytes)
            throw oro::TooSmall{"rgba: the picture is " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " pixels, which take " + std::to_string(bytes) +
                                " bytes, and there is room for " + std::to_string(capacity_)};
        ORO_CHECK(oro::check_given("rgba", rgba_));
        end_ = rgba_ + bytes;
        return {};
    }
    Result<void> take_rgb(std::span<const std::uint8_t> rgb) {
        if (static_cast<std::size_t>(end_ - rgba_) < rgb.size() / 3 * 4) return too_many();
        for (std::size_t at = 0; at + 2 < rgb.size(); at += 3) {
            *rgba_++ = rgb[at];
            *rgba_++ = rgb[at + 1];
            *rgba_++ = rgb[at + 2];
            *rgba_++ = 255;
        }
        return {};
    }
    Result<void> take_rgba(std::span<const std::uint8_t> rgba) {
        if (static_cast<std::size_t>(end_ - rgba_) < rgba.size()) return too_many();
        for (const std::uint8_t byte : rgba) *rgba_++ = byte;
        return {};
    }

  private:
    static oro::Error too_many() {
        return {oro::ErrorKind::failed, "picture", "has more rows than its size says"};
    }
    std::uint8_t* rgba_;
    std::size_t capacity_;
    std::size_t* width_px_;
    std::size_t* height_px_;
    std::uint8_t* end_{nullptr};
};

// How far a picture is, for its caller, who may stop it. Where the GPU is at work nothing is thrown: who
// draws asks stopped().
class PictureProgress {
  public:
    PictureProgress(oro_progress progress, void* user) : progress_(progress), user_(user) {}
    void show(double share, const std::string& step) {
        if (progress_ != nullptr && progress_(share, step.c_str(), user_) != 0) stop_.request_stop();
    }
    [[nodiscard]] bool stopped() const { return stop_.stop_requested(); }
    [[nodiscard]] std::stop_token token() const { return stop_.get_token(); }
    // For steps that may be left by an exception.
    oro::Progress throwing() {
        return [this](double share, const std::string& step) {
            show(share, step);
            if (stopped()) throw oro::Cancelled{};
        };
    }

  private:
    oro_progress progress_;
    void* user_;
    std::stop_source stop_;
};

// One picture at a time: each takes the memory that there is.
std::mutex& drawing() {
    static std::mutex mutex;
    return mutex;
}

// The words as the command line takes them, for a region that is open.
Result<std::unique_ptr<oro::CommandLine>> command_line_of(const char* command,
                                                          const std::vector<std::string>& given) {
    std::vector<std::string> words{"orograph", command, "region"};
    words.insert(words.end(), given.begin(), given.end());
    ORO_TRY(auto line, oro::parsed_line(
                           words, oro::bad_argument("options", "--help and --version are for the program")));
    ORO_CHECK(oro::take_coordinates(*line));
    ORO_CHECK(oro::take_named_places(*line));
    return line;
}

Result<void> refuse_word(bool given, const char* word) {
    if (given) return oro::bad_argument("options", std::string(word) + " is for the program");
    return {};
}

// Refuses words that name other data than those of the open region.
Result<void> check_region_words(const oro::CommandLine& line, const oro::RegionOptions& region) {
    ORO_CHECK(refuse_word(!region.mesh_files.empty(), "--mesh-file"));
    ORO_CHECK(refuse_word(!line.fetching.source.empty(), "--fetch"));
    ORO_CHECK(refuse_word(line.fetching.network, "--network"));
    if (region.paths.size() == 1 && oro::first_given_of_region(region) == nullptr) return {};
    return oro::bad_argument("options", "name data, or a part of them: oro_open() takes these");
}

// Refuses what has files written beside a picture.
template <class Options>
Result<void> check_no_files(const Options& options) {
    ORO_CHECK(refuse_word(!options.out.empty(), "--out"));
    ORO_CHECK(refuse_word(options.kml, "--kml"));
    ORO_CHECK(refuse_word(options.geopose, "--geopose"));
    return refuse_word(options.stac, "--stac");
}

Result<oro::ShotOptions> shot_options(const OpenRegion& open, const std::vector<std::string>& words) {
    ORO_TRY(const auto line, command_line_of("shot", words));
    oro::ShotOptions options = line->shot;
    ORO_CHECK(check_region_words(*line, options.region));
    ORO_CHECK(check_no_files(options));
    ORO_CHECK(refuse_word(!options.view_file.empty() || !options.view_files.empty(), "--view"));
    ORO_CHECK(refuse_word(options.verify, "--verify"));
    ORO_CHECK(refuse_word(options.layers, "--layers"));
    options.region = open.options;
    options.quiet = true;
    if (options.view.landcover.empty()) options.view.landcover = open.cover.landcover;
    if (options.view.canopy.empty()) {
        options.view.canopy = open.cover.canopy;
        options.view.canopy_held = open.cover.canopy_held;
    }
    options.covers = !options.view.landcover.empty();
    return options;
}

// The region of a picture: as it was opened, for a view changes it.
oro::Region region_for_view(const OpenRegion& open) {
    return open.as_opened ? *open.as_opened : open.ground->region;
}

// A shot, ready to be drawn. It stays where it is: the ground holds on to its region.
struct PreparedShot {
    oro::ShotOptions options;
    double ceiling_m{};
    oro::ShotResult shot;
    oro::Style style;
    oro::ShotGround ground;
};

// All of a shot that needs no GPU.
Result<std::unique_ptr<PreparedShot>> prepared_shot(const OpenRegion& open,
                                                    const std::vector<std::string>& words) {
    auto prepared = std::make_unique<PreparedShot>();
    oro::ShotResult& shot = prepared->shot;
    ORO_TRY(prepared->options, shot_options(open, words));
    const oro::ShotOptions& options = prepared->options;
    ORO_TRY(prepared->ceiling_m, oro::unseen_ceiling(options.unseen_ceiling_m));
    ORO_CHECK(oro::check_map_options(options));
    if (options.view.tolerance) {
        if (options.view.accuracy)
            return oro::refused("--tolerance", "", oro::either_words("--tolerance", "--accuracy"));
        if (const auto parsed = oro::parse_tolerance(*options.view.tolerance); !parsed.ok())
            return parsed.error();
    }
    shot.region = region_for_view(open);
    ORO_CHECK(oro::open_view_in_region(options.view, open.request, shot.view, shot.region));
    shot.on_summit = shot.view.stood.summit;
    if (options.ortho) ORO_CHECK(oro::make_map(shot.view, options, shot.region));
    oro::choose_legend(options, shot.view);
    ORO_TRY(prepared->style,
            oro::load_style(shot.view, shot.region.grids.front().field, oro::WorldLight::drawn));
    ORO_TRY(prepared->ground, oro::ground_of_shot(shot));
    return prepared;
}

Result<void> draw_rows(const PreparedShot& prepared, const oro::Gpu& gpu, oro::Scene& scene,
                       std::span<const std::uint8_t> strip, PictureBuffer& buffer,
                       PictureProgress& progress) {
    const oro::ShotResult& shot = prepared.shot;
    const oro::TrueGround& ground = prepared.ground.grids->ground();
    ORO_CHECK(shot.region.health());
    ORO_TRY(const oro::RasterPath path, oro::choose_path(shot.view.pipeline, gpu));
    const auto show = [&](double share) { progress.show(share, "drawing"); };
    const auto unless_stopped = [&](Result<void> taken) -> Result<void> {
        if (progress.stopped()) return oro::Error{oro::ErrorKind::failed, "", "stopped"};
        return taken;
    };
    oro::PictureReport report;
    if (shot.view.map) {
        ORO_TRY(const oro::LabelledMap map,
                oro::draw_labelled_map(
                    gpu, scene, shot.view, ground, prepared.style, path,
                    [&](auto row) { return unless_stopped(buffer.take_rgba(row)); }, show));
        report = map.report;
    } else {
        ORO_TRY(const oro::LabelledPicture picture,
                oro::render_labelled(
                    gpu, scene, shot.view, ground, prepared.style, path,
                    [&](auto row) { return unless_stopped(buffer.take_rgb(row)); }, show));
        report = picture.report;
    }
    ORO_CHECK(buffer.take_rgb(strip));
    return oro::check_drawn(gpu, scene, report);
}

Result<void> answer_shot(const OpenRegion& open, const std::vector<std::string>& words, PictureBuffer& buffer,
                         PictureProgress& progress) {
    ORO_TRY(const auto prepared, prepared_shot(open, words));
    oro::ShotResult& shot = prepared->shot;
    ORO_TRY(shot.middle, oro::place_in_middle(shot.view, *prepared->ground.grids));
    // What --tolerance chooses changes what the strip says, and not its height.
    ORO_TRY(std::vector<std::uint8_t> strip,
            oro::strip_of(shot.view, shot.region, prepared->style, shot.middle, *prepared->ground.grids));
    ORO_CHECK(buffer.begin(shot.view.camera.width_px, shot.view.camera.height_px + shot.view.legend_px));
    const std::lock_guard lock(drawing());
    ORO_TRY(const auto gpu, oro::Gpu::create(oro::gpu_options_from_environment()));
    ORO_TRY(oro::ShotScene drawn,
            oro::scene_of_shot(prepared->options, prepared->ceiling_m, *gpu, prepared->style,
                               prepared->ground, progress.throwing(), shot));
    oro::Scene& scene = drawn.whole.scene;
    ORO_CHECK(oro::check_in_view(shot, "", scene));
    if (prepared->options.view.tolerance) {
        ORO_TRY(strip,
                oro::strip_of(shot.view, shot.region, prepared->style, shot.middle, *prepared->ground.grids));
    }
    return draw_rows(*prepared, *gpu, scene, strip, buffer, progress);
}

template <class Value>
void give_layer(const std::vector<Value>& layer, Value* values) {
    if (values != nullptr) std::ranges::copy(layer, values);
}

// Before anything is drawn: the size of layers, and that there is room for those that are wanted.
Result<void> check_layers_of(const PreparedShot& prepared, const oro_layers& layers, std::size_t* width_px,
                             std::size_t* height_px) {
    const oro::Camera& camera = prepared.shot.view.camera;
    if (prepared.shot.view.map)
        return oro::bad_argument("options", "--ortho makes a map, which has no layers");
    if (layers.cover != nullptr && !prepared.shot.view.cover)
        return oro::bad_argument("cover", "is wanted of a view without land cover");
    ORO_CHECK(oro::check_layers(camera));
    *width_px = static_cast<std::size_t>(camera.width_px);
    *height_px = static_cast<std::size_t>(camera.height_px);
    if (layers.capacity < *width_px * *height_px)
        throw oro::TooSmall{"layers: the picture has " + std::to_string(*width_px * *height_px) +
                            " pixels, and there is room for " + std::to_string(layers.capacity)};
    return {};
}

Result<void> answer_layers(const OpenRegion& open, const std::vector<std::string>& words,
                           const oro_layers& layers, std::size_t* width_px, std::size_t* height_px,
                           PictureProgress& progress) {
    ORO_TRY(const auto prepared, prepared_shot(open, words));
    ORO_CHECK(check_layers_of(*prepared, layers, width_px, height_px));
    const oro::View& view = prepared->shot.view;
    const std::lock_guard lock(drawing());
    ORO_TRY(const auto gpu, oro::Gpu::create(oro::gpu_options_from_environment()));
    ORO_TRY(oro::ShotScene drawn,
            oro::scene_of_shot(prepared->options, prepared->ceiling_m, *gpu, prepared->style,
                               prepared->ground, progress.throwing(), prepared->shot));
    oro::Scene& scene = drawn.whole.scene;
    ORO_CHECK(oro::check_in_view(prepared->shot, "", scene));
    ORO_TRY(const oro::RasterPath path, oro::choose_path(view.pipeline, *gpu));
    ORO_TRY(const oro::PictureLayers found,
            oro::picture_layers(*gpu, scene, view, *prepared->ground.grids, prepared->style, path,
                                [&](double share) { progress.show(share, "measuring layers"); }));
    if (progress.stopped()) throw oro::Cancelled{};
    give_layer(found.longitude_deg, layers.longitude_deg);
    give_layer(found.latitude_deg, layers.latitude_deg);
    give_layer(found.H_m, layers.H_m);
    give_layer(found.h_m, layers.h_m);
    give_layer(found.distance_m, layers.distance_m);
    give_layer(found.slope_deg, layers.slope_deg);
    give_layer(found.source, layers.source);
    give_layer(found.shadow, layers.shadow);
    give_layer(found.cover, layers.cover);
    return {};
}

Result<oro::PanoramaOptions> panorama_options(const OpenRegion& open, const std::vector<std::string>& words) {
    ORO_TRY(const auto line, command_line_of("panorama", words));
    oro::PanoramaOptions options = line->panorama;
    ORO_CHECK(check_region_words(*line, options.region));
    ORO_CHECK(check_no_files(options));
    ORO_CHECK(refuse_word(!options.view_file.empty(), "--view"));
    ORO_CHECK(oro::check_panorama_view(options));
    options.region = open.options;
    options.quiet = true;
    if (options.view.landcover.empty()) options.view.landcover = open.cover.landcover;
    if (options.view.canopy.empty()) {
        options.view.canopy = open.cover.canopy;
        options.view.canopy_held = open.cover.canopy_held;
    }
    return options;
}

Result<void> answer_panorama(const OpenRegion& open, const std::vector<std::string>& words,
                             PictureBuffer& buffer, PictureProgress& progress) {
    ORO_TRY(const oro::PanoramaOptions options, panorama_options(open, words));
    ORO_TRY(const oro::AskedFrame asked, oro::asked_frame(options));
    oro::View view;
    oro::Region region = region_for_view(open);
    ORO_CHECK(oro::open_view_in_region(oro::view_options_of(options), open.request, view, region));
    // view.mesh tells what is drawn from then on.
    if (const auto drawn = oro::draws_terrain_clusters(region, view); !drawn.ok()) return drawn.error();
    ORO_TRY(const oro::RegionCuts cuts, oro::cut_regions(region));
    ORO_TRY(const auto ground, oro::RegionGround::of(region, cuts, view.exaggeration));
    ORO_CHECK(oro::set_frame(asked, ground->ground(), view));
    ORO_TRY(const oro::Style style, oro::style_of_panorama(view, region));
    ORO_TRY(const oro::PanoramaSheet laid, oro::lay_out(view, region, ground->ground()));
    ORO_CHECK(buffer.begin(laid.sheet.width_px, laid.sheet.height_px));
    const std::lock_guard lock(drawing());
    ORO_TRY(const oro::CylinderPicture scene,
            oro::draw_panorama(view, region, cuts, ground->ground(), style, laid.around,
                               {options.memory, true, progress.token()},
                               [&](double share, const std::string& step) { progress.show(share, step); }));
    return oro::give_rows(laid.sheet, scene, [&](auto row) { return buffer.take_rgb(row); });
}

using Answer = Result<void> (*)(const OpenRegion&, const std::vector<std::string>&, PictureBuffer&,
                                PictureProgress&);

oro_status draw(Answer answer, oro_region region, std::size_t count, const char* const* options,
                PictureBuffer buffer, const std::size_t* width_px, const std::size_t* height_px,
                oro_progress progress, void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("width_px", width_px));
        ORO_CHECK(oro::check_given("height_px", height_px));
        ORO_TRY(const auto open, oro::region_of(region));
        ORO_TRY(const auto words, oro::strings_of("options", options, count));
        PictureProgress shown(progress, user);
        const Result<void> drawn = answer(*open, words, buffer, shown);
        if (shown.stopped()) throw oro::Cancelled{};
        return drawn;
    });
}

}  // namespace

oro_status oro_shot(oro_region region, size_t count, const char* const* options, uint8_t* rgba,
                    size_t capacity, size_t* width_px, size_t* height_px, oro_progress progress, void* user) {
    return draw(&answer_shot, region, count, options, {rgba, capacity, width_px, height_px}, width_px,
                height_px, progress, user);
}

oro_status oro_shot_layers(oro_region region, size_t count, const char* const* options,
                           const oro_layers* layers, size_t* width_px, size_t* height_px,
                           oro_progress progress, void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("layers", layers));
        ORO_CHECK(oro::check_size("layers", layers->size, sizeof(oro_layers)));
        ORO_CHECK(oro::check_given("width_px", width_px));
        ORO_CHECK(oro::check_given("height_px", height_px));
        ORO_TRY(const auto open, oro::region_of(region));
        ORO_TRY(const auto words, oro::strings_of("options", options, count));
        PictureProgress shown(progress, user);
        return answer_layers(*open, words, *layers, width_px, height_px, shown);
    });
}

oro_status oro_panorama(oro_region region, size_t count, const char* const* options, uint8_t* rgba,
                        size_t capacity, size_t* width_px, size_t* height_px, oro_progress progress,
                        void* user) {
    return draw(&answer_panorama, region, count, options, {rgba, capacity, width_px, height_px}, width_px,
                height_px, progress, user);
}
