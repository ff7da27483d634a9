// The calls of the library about horizons.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>

#include "apps/commands/sight/horizon_question.h"
#include "apps/library/guarded_call.h"
#include "apps/library/library_structures.h"
#include "apps/library/open_regions.h"
#include "apps/library/orograph.h"

namespace {

using oro::Result;

// What is asked, and the region that it is asked over, which stays while it is.
struct AskedHorizons {
    std::shared_ptr<const oro::OpenRegion> open;
    std::size_t grid{};
    oro::PostHorizonsRequest request;
};

Result<AskedHorizons> asked_horizons(oro_region region, const oro_horizon_options* given) {
    ORO_TRY(const oro_horizon_options options,
            oro::options_of<oro_horizon_options>(given, ORO_HORIZON_OPTIONS));
    constexpr int fewest = 3, most = 720;
    if (options.directions < fewest || options.directions > most)
        return oro::bad_argument("directions",
                                 std::to_string(options.directions) + " is not between 3 and 720");
    if (!std::isfinite(options.above_m)) return oro::bad_argument("above_m", "is no number");
    oro::HorizonOptions asked_of_program;
    asked_of_program.directions = options.directions;
    asked_of_program.radius_km = options.radius_km;
    asked_of_program.above_m = options.above_m;
    AskedHorizons asked;
    ORO_TRY(asked.request, oro::horizon_request(asked_of_program));
    ORO_TRY(asked.request.air, oro::air_of(options.air, options.refraction_k));
    std::optional<oro::BoundingBox> box;
    const std::string text = options.bbox != nullptr ? options.bbox : "";
    if (!text.empty()) {
        ORO_TRY(box, oro::parse_bounding_box(text));
    }
    ORO_TRY(asked.open, oro::region_of(region));
    ORO_TRY(const oro::HorizonPosts posts,
            oro::horizon_posts(box, "bbox " + text, asked.open->ground->ground(), options.directions));
    asked.grid = posts.grid;
    asked.request.part = posts.part;
    return asked;
}

void fill_window(const AskedHorizons& asked, oro_window& window) {
    oro::fill_window(asked.grid, asked.open->ground->grids->grid(asked.grid), asked.request.part, window);
}

// Looks around; the caller's progress function stops it.
Result<oro::PostHorizons> found_horizons(AskedHorizons& asked, oro_progress progress, void* user) {
    std::stop_source stop;
    asked.request.stop = stop.get_token();
    const oro::TrueGround& ground = asked.open->ground->ground();
    oro::PostHorizons found = oro::post_horizons(ground, asked.grid, asked.request, [&](double share) {
        if (progress != nullptr && progress(share, "looking around", user) != 0) stop.request_stop();
    });
    if (stop.stop_requested()) throw oro::Cancelled{};
    ORO_CHECK(ground.health());
    return found;
}

void give_values(const oro::PostHorizons& found, float* elevation_deg, float* sky_view, oro_window& window) {
    const auto is_known = [](float value) { return value != oro::PostHorizons::unknown; };
    window.seen = static_cast<std::size_t>(std::ranges::count_if(found.sky_view, is_known));
    window.known = 0;
    for (std::size_t i = 0; i < found.sky_view.size(); ++i)
        window.known +=
            std::ranges::any_of(found.elevation_deg, [&](const auto& all) { return is_known(all[i]); }) ? 1U
                                                                                                        : 0U;
    if (sky_view != nullptr) std::ranges::copy(found.sky_view, sky_view);
    if (elevation_deg == nullptr) return;
    for (const std::vector<float>& in_azimuth : found.elevation_deg)
        elevation_deg = std::ranges::copy(in_azimuth, elevation_deg).out;
}

}  // namespace

oro_status oro_horizon_window(oro_region region, const oro_horizon_options* options, oro_window* window) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_window(window));
        ORO_TRY(const AskedHorizons asked, asked_horizons(region, options));
        fill_window(asked, *window);
        return {};
    });
}

oro_status oro_horizon(oro_region region, const oro_horizon_options* options, float* elevation_deg,
                       float* sky_view, size_t capacity, oro_window* window, oro_progress progress,
                       void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_window(window));
        ORO_TRY(AskedHorizons asked, asked_horizons(region, options));
        fill_window(asked, *window);
        const std::size_t posts = asked.request.part.count();
        if (capacity < posts)
            throw oro::TooSmall{"buffers: the window has " + std::to_string(posts) +
                                " posts, and there is room for " + std::to_string(capacity)};
        if (elevation_deg == nullptr && sky_view == nullptr)
            return oro::bad_argument("buffers", "both are NULL");
        ORO_TRY(const oro::PostHorizons found, found_horizons(asked, progress, user));
        give_values(found, elevation_deg, sky_view, *window);
        return {};
    });
}
