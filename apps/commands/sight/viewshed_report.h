// What is seen from one place or several: as the command viewshed reckons it, tells it and writes it.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/drape/post_colours.h"
#include "core/sight/viewshed.h"
#include "geo/rasters/post_raster.h"
#include "geo/together/mesh_roofs.h"
#include "geo/together/region_ground.h"

namespace oro {

inline constexpr double usual_radius_km = 20.0, least_radius_km = 0.01, most_radius_km = 1000.0;

struct ViewshedQuestion {
    std::vector<Geodetic> eyes;  // one or more, over the ground
    std::string at;              // how errors call the first of them: "46.67,8.06"
    Air air;
    double target_m{};  // height of targets over the ground
    double radius_km{usual_radius_km};
    bool are_recorded_one_by_one{true};  // the file has a tag for each eye; else one that counts them
    // What targets stand on, where that is not what hides them (ViewshedRequest); outlives the question.
    const TrueGround* footing{nullptr};
    // Tops that targets stand on, where there are some (ViewshedRequest); outlive the question.
    const MeshRoofs* roofs{nullptr};
};

struct ViewshedReport {
    ViewshedQuestion question;
    std::size_t grid{};  // whose posts `window` has
    GridPart window;
    std::vector<float> clearance_deficit_m;  // of the eye that misses it least
    std::vector<float> count;                // of eyes that see it
    struct SeenByEye {
        std::size_t cells{}, seen{};
    };
    std::vector<SeenByEye> each;  // of the question's eyes: posts within its radius, and seen by it
    std::size_t cells{}, seen{};  // posts within the radius, and those of them that are seen
    std::size_t asked{};          // of the oracle
    double looking_s{};
};

// Where the values of a window's posts are put, row by row: as many of each as the window has posts.
struct ViewshedValues {
    std::span<float> clearance_deficit_m;
    std::span<float> count;
};

// The window that a question takes; no values yet. Errors: no data within the radius (no_data); too many
// posts (usage).
Result<ViewshedReport> viewshed_window(const ViewshedQuestion& question, const RegionGround& ground);

// Looks around, as viewshed_report() does, and puts the values where they are wanted; the report's own stay
// empty. Errors: those of viewshed_report(), with values that are then worth nothing.
Result<void> look_around(const RegionGround& ground, const ViewshedValues& values, ViewshedReport& report,
                         const ViewshedProgress& progress = {}, const std::stop_token& stop = {});

// Looks around, on as many threads as are worth it. Asked to stop, it ends soon, with an error that nobody
// need be told. Errors: no data within the radius (no_data); too many posts (usage); posts that cannot be
// read.
Result<ViewshedReport> viewshed_report(const ViewshedQuestion& question, const RegionGround& ground,
                                       const ViewshedProgress& progress = {},
                                       const std::stop_token& stop = {});

// "Seen: 1,234 of 5,678 posts within 20 km, 21.73 %"
std::string seen_words(const ViewshedReport& report);
// "46.670000000,8.060000000 H 2000.000 m h 2050.000 m"
std::string eye_text(const Geodetic& eye, const TrueGround& ground);
// The file whose posts a report has.
std::string source_of_posts(const ViewshedReport& report, const RegionGround& ground);

// What the command's GeoTIFF holds (write_post_raster() writes it). The report's values of posts move into
// it; all else of the report stays.
PostRaster raster_of(ViewshedReport& report, const RegionGround& ground);
// Its posts as colours over the ground: those that are seen bright, those that are hidden dark, all others
// none.
PostColours colours_of(const ViewshedReport& report, const RegionGround& ground);

}  // namespace oro
