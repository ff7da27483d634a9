#include "apps/commands/sight/horizon_question.h"

#include "apps/command_line/refusals.h"
#include "apps/commands/sight/horizon_part.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/options/view_limits.h"
#include "apps/report/figures.h"
#include "apps/view/view.h"
#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr double usual_horizon_km = 50.0, least_horizon_km = 0.01, most_horizon_km = 500.0;
constexpr int usual_directions = 36;
// At 4 bytes each they take 2 GB.
constexpr double most_values = 5.0e8;

}  // namespace

Result<PostHorizonsRequest> horizon_request(const HorizonOptions& options) {
    PostHorizonsRequest request;
    const double radius_km = options.radius_km.value_or(usual_horizon_km);
    if (!(radius_km >= least_horizon_km && radius_km <= most_horizon_km))
        return refused("--radius", all_digits(radius_km), between_words(least_horizon_km, most_horizon_km));
    ORO_CHECK(check_above("--above", options.above_m));
    request.above_m = options.above_m.value_or(0.0);
    if (request.above_m > view_limits::above_m.high)
        return refused("--above", all_digits(request.above_m), between_words(0.0, view_limits::above_m.high));
    request.radius_m = 1000.0 * radius_km;
    request.directions = options.directions.value_or(usual_directions);
    request.threads = thread_count();
    ORO_TRY(request.air, air_asked_for(options.view.refraction_k, options.view.air, standard_air));
    return request;
}

Result<HorizonPosts> horizon_posts(const std::optional<BoundingBox>& box, const std::string& where,
                                   const TrueGround& ground, int directions) {
    HorizonPosts most{};
    for (std::size_t i = 0; i < ground.grids(); ++i) {
        const GridPart part = part_in_box(ground.surface(i).field().grid, box);
        if (part.count() > most.part.count()) most = {i, part};
    }
    if (most.part.count() == 0) return Error{ErrorKind::no_data, where, "no elevation data there"};
    const double values = static_cast<double>(most.part.count()) * directions;
    if (values > most_values)
        return refused("--directions", std::to_string(directions),
                       "takes " + grouped(static_cast<std::uint64_t>(values)) + " values of " +
                           counted(most.part.count(), "post", "posts") +
                           ", more than 500,000,000: give fewer, or a smaller --bbox");
    return most;
}

}  // namespace oro
