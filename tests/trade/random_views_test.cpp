// Must hold in views that nobody has looked at before: what plan predicts is never exceeded by any of the
// four measures, and a tolerance is kept by the bundle that was chosen for it. OROGRAPH_RANDOM_VIEWS (default
// 50) of OROGRAPH_RANDOM_SEED; scripts/random-views asks for more.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>

#include "apps/view/accuracy.h"
#include "core/base/parallel.h"
#include "core/measure/picture_errors.h"
#include "geo/opening/open_region.h"
#include "render/frame/depth_picture.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/region_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_data.h"
#include "tests/trade/random_view.h"

namespace oro {
namespace {

using test::Random;
using test::RandomView;

constexpr std::uint64_t usual_views = 50, usual_seed = 20261122, views_of_a_region = 7;

// The four measures of a picture, px, as PictureErrors::largest_px() has them.
struct Measures {
    double displacement{}, surface{}, seen{}, skyline{};
    Measures() = default;
    explicit Measures(const PictureErrors& errors)
        : displacement(errors.ground.summary_displacement_px.largest),
          surface(errors.ground.summary_surface_px.largest),
          seen(std::max(0.0, errors.seen.summary_px.largest - seen_resolution_px)),
          skyline(std::max(0.0, errors.skyline.summary_px.largest - seen_resolution_px)) {}
    [[nodiscard]] double largest() const { return std::max({displacement, surface, seen, skyline}); }
    void widen(const Measures& by) {
        displacement = std::max(displacement, by.displacement);
        surface = std::max(surface, by.surface);
        seen = std::max(seen, by.seen);
        skyline = std::max(skyline, by.skyline);
    }
    [[nodiscard]] std::string text() const {
        char line[120];
        std::snprintf(line, sizeof line, "displacement %.4g, surface %.4g, seen %.4g, skyline %.4g px",
                      displacement, surface, seen, skyline);
        return line;
    }
};

// What came of the views of one region, or of all.
struct Tally {
    int views{}, empty{}, too_large{}, broken{}, loose{};
    int kept{}, exceeded{}, not_promised{};
    int with_tau{}, beyond_allowed{};
    double predicted_px{}, least_ratio{1e9};
    Measures measured;
    std::uint64_t pixels{}, beyond_data{}, in_one_only{};
    void add(const Tally& other) {
        views += other.views, empty += other.empty, too_large += other.too_large;
        broken += other.broken, loose += other.loose;
        kept += other.kept, exceeded += other.exceeded, not_promised += other.not_promised;
        with_tau += other.with_tau, beyond_allowed += other.beyond_allowed;
        predicted_px = std::max(predicted_px, other.predicted_px);
        least_ratio = std::min(least_ratio, other.least_ratio);
        measured.widen(other.measured);
        pixels += other.pixels, beyond_data += other.beyond_data, in_one_only += other.in_one_only;
    }
    void tell(const std::string& name) const {
        std::printf("%-44.44s %5d %10.4g %9.3g %9.3g %9.3g %9.3g %8.2f %5d %4d %4d %4d %4d\n", name.c_str(),
                    views, predicted_px, measured.displacement, measured.surface, measured.seen,
                    measured.skyline, least_ratio, loose, broken, kept, exceeded, not_promised);
        std::fflush(stdout);
    }
};

void tell_head() {
    std::printf("%-44s %5s %10s %9s %9s %9s %9s %8s %5s %4s %4s %4s %4s\n", "region", "views", "predicted",
                "displaced", "surface", "seen", "skyline", "ratio >=", ">10 x", "brkn", "kept", "excd",
                "none");
}

// A region that is open, with what drawing and measuring need of it.
struct Opened {
    RegionOptions options;
    Region region{std::vector<RegionGrid>(1)};
    double exaggeration{1.0};
    double highest_H_m{};
    std::unique_ptr<TrueScene> truth;
    std::map<HeightStorage, Scene> scenes;

    [[nodiscard]] const TrueSurface& surface() const { return truth->ground().surface(0); }
    Result<Scene*> scene(const Gpu& gpu, HeightStorage heights) {
        if (const auto found = scenes.find(heights); found != scenes.end()) return &found->second;
        ORO_TRY(Scene made,
                test::create_scene(gpu, region, {.exaggeration = exaggeration, .heights = heights}));
        return &scenes.emplace(heights, std::move(made)).first->second;
    }
    Result<const RegionPages*> pages(const Gpu& gpu) {
        ORO_TRY(Scene* const any, scene(gpu, HeightStorage::f32));
        return &any->grids()[0].pages();
    }
};

std::string name_of(const RegionOptions& options) {
    const std::filesystem::path first(options.paths.front());
    std::string name = first.parent_path().filename().string() + "/" + first.filename().string();
    if (options.paths.size() > 1) name += " + " + std::to_string(options.paths.size() - 1);
    if (!options.bbox.empty()) name = first.filename().string() + " " + options.bbox;
    return options.fill_voids ? name + " filled" : name;
}

class RandomViews : public test::GpuTest {
  protected:
    Result<std::unique_ptr<Opened>> open(Random& random, const RegionOptions& options) {
        auto opened = std::make_unique<Opened>();
        opened->options = options;
        ORO_TRY(const RegionRequest request, region_request(options));
        ORO_TRY(opened->region, open_region(request));
        const bool geoid = random() % 6 != 0;
        if (!geoid) leave_geoid_out(opened->region);
        if (random() % 8 == 0) opened->exaggeration = static_cast<double>(1 + random() % 16) / 4.0;
        opened->highest_H_m =
            std::max(0.0, opened->exaggeration * height_range(opened->region.grids[0].field).highest_m);
        View view;
        view.exaggeration = opened->exaggeration;
        ORO_TRY(opened->truth, TrueScene::of(view, opened->region));
        ORO_TRY([[maybe_unused]] const RegionPages* const pages, opened->pages(*gpu_));
        return opened;
    }

    // A view of the options, drawn and held against the truth in that air.
    struct Drawn {
        Measures measured;
        PictureErrors errors;
        double slack_px{};
        bool settled{};
    };
    Result<Drawn> draw(Opened& opened, const View& view, RasterPath path, const TruePicture& truth) {
        ORO_TRY(Scene* const scene, opened.scene(*gpu_, view.heights));
        DepthPictureOptions options;
        options.tau_px = view.tau_px;
        options.model = view.model;
        DepthPainter& painter = painters_.try_emplace(path, *gpu_, path).first->second;
        const gpu::FrameStyle style{};
        ORO_TRY(const DepthPicture picture, painter.draw(*scene, view.camera, style, options));
        Drawn drawn;
        drawn.settled = picture.settled;
        drawn.errors = picture_errors(truth, picture.points, picture.skylines(), thread_count());
        drawn.measured = Measures(drawn.errors);
        drawn.slack_px = drawn.errors.slack_px;
        return drawn;
    }

    // The view that a command line asks for.
    static Result<View> view_of(const Opened& opened, const ViewOptions& options) {
        ORO_TRY(View view, view_without_eye(options, {}));
        ORO_CHECK(place_eye(view, options, opened.region));
        return view;
    }

    static void count(const Drawn& drawn, Tally& tally) {
        tally.measured.widen(drawn.measured);
        tally.pixels += drawn.errors.ground.drawn;
        tally.beyond_data += drawn.errors.ground.beyond_data;
        tally.in_one_only += drawn.errors.skyline.in_one_only;
    }

    static std::string effects_text(const EffectPrediction& prediction, const DrawingModel& drawing,
                                    const EarthParameters& world) {
        std::string text;
        for (const EffectFacts& facts : effect_table()) {
            if (facts.group == EffectGroup::data || !facts.in_picture(drawing, world)) continue;
            const auto size = prediction.size(facts.kind, drawing.tau_px);
            char part[100];
            if (size.ok() && *size)
                std::snprintf(part, sizeof part, "%s %.4g px %.4g m; ", facts.key, (*size)->worst_px,
                              (*size)->worst_m);
            text += part;
        }
        return text;
    }

    // Where levels are all that is left out, no error exceeds tau and what drawing rounds off: what --verify
    // says is allowed.
    static void hold_tau(const Opened& opened, const RandomView& one, const View& view,
                         const EarthParameters& world, const Drawn& drawn, Tally& tally) {
        if (view.model.air != world.air || view.model.earth != Earth::ellipsoid || !view.has_geoid ||
            view.model.precision != Precision::relative || view.heights != HeightStorage::f32)
            return;
        ++tally.with_tau;
        const double allowed_px = view.tau_px + drawn.slack_px;
        if (drawn.measured.largest() <= allowed_px) return;
        ++tally.beyond_allowed;
        ADD_FAILURE() << "allowed " << allowed_px << " px, measured " << drawn.measured.text() << ", nearest "
                      << drawn.errors.nearest_m << " m\n  "
                      << test::command_line(opened.options, one.drawing);
    }

    // (a) What plan says of a drawing holds.
    void hold_prediction(Opened& opened, const RandomView& one, const View& view,
                         const EarthParameters& world, const TruePicture& truth, const Camera& camera,
                         Tally& tally) {
        const auto pages = opened.pages(*gpu_);
        ASSERT_TRUE(pages.ok());
        const EffectPrediction prediction(opened.surface(), **pages, camera, world, thread_count());
        const DrawingModel drawing = drawing_model(view, world);
        const auto total = prediction.total(drawing);
        ASSERT_TRUE(total.ok()) << total.error().line();
        const auto drawn = draw(opened, view, one.path, truth);
        ASSERT_TRUE(drawn.ok()) << drawn.error().line();
        if (!drawn->settled) {
            ++tally.too_large;
            return;
        }
        count(*drawn, tally);
        if (drawn->errors.ground.drawn == 0 && prediction.empty()) ++tally.empty;
        hold_tau(opened, one, view, world, *drawn, tally);
        // Farther than the picture's diagonal no bound reaches.
        const double measured_px =
            std::min(drawn->measured.largest(), std::hypot(view.camera.width_px, view.camera.height_px));
        const double measured_m = drawn->errors.ground.summary_displacement_m.largest;
        tally.predicted_px = std::max(tally.predicted_px, total->worst_px);
        constexpr double smallest_px = 1.0e-3;  // below it a ratio says nothing
        if (measured_px > smallest_px) {
            const double ratio = total->worst_px / measured_px;
            tally.least_ratio = std::min(tally.least_ratio, ratio);
            if (total->worst_px > 0.1 && ratio > 10.0) ++tally.loose;
        }
        if (measured_px <= total->worst_px && measured_m <= total->worst_m) return;
        ++tally.broken;
        ADD_FAILURE() << "predicted " << total->worst_px << " px, " << total->worst_m << " m; measured "
                      << drawn->measured.text() << "; " << measured_m << " m\n  "
                      << effects_text(prediction, drawing, world) << "nearest " << drawn->errors.nearest_m
                      << " m\n  " << test::command_line(opened.options, one.drawing);
    }

    // (b) A bundle that is said to hold a tolerance holds it.
    void hold_tolerance(Opened& opened, const RandomView& one, const TruePicture& truth, Tally& tally) {
        auto view = view_of(opened, one.toleranced);
        ASSERT_TRUE(view.ok()) << view.error().line();
        const auto pages = opened.pages(*gpu_);
        ASSERT_TRUE(pages.ok());
        const double tolerance_px = *parse_tolerance(*one.toleranced.tolerance);
        FixedAccuracy fixed;
        if (one.toleranced.air || one.toleranced.refraction_k) fixed.air = view->model.air;
        const auto choice =
            choose_accuracy(*view, opened.region, opened.surface(), **pages, tolerance_px, fixed);
        ASSERT_TRUE(choice.ok()) << choice.error().line();
        if (!choice->holds) {
            ++tally.not_promised;
            return;
        }
        apply_bundle(choice->bundle, *view);
        const auto drawn = draw(opened, *view, one.path, truth);
        ASSERT_TRUE(drawn.ok()) << drawn.error().line();
        if (!drawn->settled) {
            ++tally.too_large;
            return;
        }
        count(*drawn, tally);
        if (drawn->measured.largest() <= tolerance_px) {
            ++tally.kept;
            return;
        }
        ++tally.exceeded;
        ADD_FAILURE() << "tolerance " << tolerance_px << " px, " << choice->bundle.name << " predicted "
                      << choice->predicted_px << "; measured " << drawn->measured.text() << ", nearest "
                      << drawn->errors.nearest_m << " m\n  "
                      << test::command_line(opened.options, one.toleranced);
    }

    void look(Opened& opened, Random random, Tally& tally) {
        const bool geoid = opened.region.grids[0].geoid_left_out.N_m.empty();
        const RandomView one = test::random_view(
            random, {opened.region, opened.exaggeration, geoid, opened.highest_H_m}, opened.surface());
        const auto view = view_of(opened, one.drawing);
        ASSERT_TRUE(view.ok()) << view.error().line() << test::command_line(opened.options, one.drawing);
        const auto pages = opened.pages(*gpu_);
        ASSERT_TRUE(pages.ok());
        const auto world = earth_parameters(*view, opened.region, **pages);
        ASSERT_TRUE(world.ok()) << world.error().line();
        const Camera camera = true_camera(*view, opened.region);
        const Sight sight = sight_from(camera.eye, world->air);
        const TruePicture truth(opened.surface(), sight, camera, thread_count());
        ++tally.views;
        hold_prediction(opened, one, *view, *world, truth, camera, tally);
        hold_tolerance(opened, one, truth, tally);
    }

    void TearDown() override {
        painters_.clear();
        GpuTest::TearDown();
    }

    std::map<RasterPath, DepthPainter> painters_;
};

TEST_F(RandomViews, BoundsAndTolerancesHold) {
    const auto data = test::real_data("");
    if (!data) GTEST_SKIP() << "needs the real data";
    const std::uint64_t seed = test::asked_number("OROGRAPH_RANDOM_SEED", usual_seed);
    const std::uint64_t views = test::asked_number("OROGRAPH_RANDOM_VIEWS", usual_views);
    const std::uint64_t only =
        test::asked_number("OROGRAPH_RANDOM_ONLY", views);  // one view, to look into it
    test::RandomRegions regions(*data, seed, views > 2 * usual_views);
    std::printf("%llu views, seed %llu; px\n", static_cast<unsigned long long>(views),
                static_cast<unsigned long long>(seed));
    tell_head();
    const std::clock_t start = std::clock();
    Tally all;
    std::map<std::string, std::string> refused;
    int opened_regions = 0;
    for (std::uint64_t view = 0; view < views && view <= only;) {
        const RegionOptions options = regions.next();
        Random of_region(seed * 1000003 + view);
        auto opened = open(of_region, options);
        if (!opened.ok()) {
            refused[name_of(options)] = opened.error().line();
            ASSERT_LT(refused.size(), 1000U) << "hardly any data can be opened";
            continue;
        }
        ++opened_regions;
        Tally of_this;
        for (std::uint64_t i = 0; i < views_of_a_region && view < views; ++i, ++view) {
            SCOPED_TRACE("view " + std::to_string(view) + " of seed " + std::to_string(seed));
            if (only == views || only == view) look(**opened, Random(seed * 1000003 + view + 1), of_this);
        }
        of_this.tell(name_of(options));
        all.add(of_this);
    }
    all.tell("all");
    std::printf("%d regions, %zu refused; %.0f s of processor time\n", opened_regions, refused.size(),
                static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    for (const auto& [name, why] : refused) std::printf("refused: %s: %s\n", name.c_str(), why.c_str());
    std::printf("%d drawings with levels alone left out, %d of them beyond tau and what drawing rounds off\n",
                all.with_tau, all.beyond_allowed);
    std::printf(
        "%llu pixels of ground, %llu of them where there are no data; %llu columns with a skyline in one of "
        "the two only\n",
        static_cast<unsigned long long>(all.pixels), static_cast<unsigned long long>(all.beyond_data),
        static_cast<unsigned long long>(all.in_one_only));
}

}  // namespace
}  // namespace oro
