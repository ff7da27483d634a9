// The calls of the library about errors, regions and heights.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>

#include "apps/commands/info_json.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/fingerprints/fingerprints.h"
#include "apps/library/guarded_call.h"
#include "apps/library/library_data.h"
#include "apps/library/library_structures.h"
#include "apps/library/open_regions.h"
#include "apps/library/orograph.h"
#include "apps/report/json_text.h"
#include "core/base/parallel.h"
#include "core/sight/ground_profile.h"
#include "geo/listing/file_listing.h"
#include "geo/opening/baked_region.h"

namespace {

using oro::OpenRegion;
using oro::Result;

std::string text_or_none(const char* text) {
    return text != nullptr ? text : "";
}

struct AskedRegion {
    oro::RegionOptions region;
    oro::ViewOptions cover;
};

Result<AskedRegion> asked_region(const oro_open_options& given) {
    // The size of the first version of this interface.
    constexpr std::size_t first_size = sizeof(oro_open_options);
    ORO_CHECK(oro::check_size("options", given.size, first_size));
    AskedRegion asked;
    oro::RegionOptions& region = asked.region;
    region.bbox = text_or_none(given.bbox);
    region.tile = text_or_none(given.tile);
    if (!region.bbox.empty() && !region.tile.empty())
        return oro::bad_argument("tile", "is not for a region with a bbox");
    region.height_unit = text_or_none(given.height_unit);
    constexpr std::array<std::string_view, 6> height_units{"m", "ft", "us-ft", "cm", "dm", "mm"};
    if (!region.height_unit.empty() &&
        std::ranges::find(height_units, region.height_unit) == height_units.end())
        return oro::bad_argument("height_unit", region.height_unit + " is none of m, ft, us-ft, cm, dm, mm");
    region.source_crs = text_or_none(given.source_crs);
    region.source_vertical = text_or_none(given.source_vertical);
    region.order = text_or_none(given.order);
    if (!region.order.empty() && region.order != "finest" && region.order != "listed")
        return oro::bad_argument("order", region.order + " is neither finest nor listed");
    if (given.feather_m != 0.0) region.feather_m = given.feather_m;
    region.strict_datum = given.strict_datum != 0;
    region.fill_voids = given.fill_voids != 0;
    region.resample = given.resample != 0;
    ORO_TRY(asked.cover.landcover, oro::strings_of("landcover", given.landcover, given.landcover_count));
    ORO_TRY(asked.cover.canopy, oro::strings_of("canopy", given.canopy, given.canopy_count));
    if (!(given.canopy_held < 0.0)) asked.cover.canopy_held = given.canopy_held;
    return asked;
}

// The text of `info --json`.
Result<std::string> info_text_of(const OpenRegion& region) {
    nlohmann::ordered_json json = region.info;
    if (!oro::baked_path(region.request.paths)) {
        ORO_TRY(
            const oro::FileListing listing,
            oro::list_files(region.request, {oro::cache_folder().string(), oro::program_fingerprint()}, {}));
        json["passed_over"] = oro::files_json(listing.files, false);
    }
    return oro::json_text(json, true) + "\n";
}

// Heights of some places, by as many threads as they are worth.
void find_heights(const oro::TrueGround& ground, std::size_t count, const double* lat_deg,
                  const double* lon_deg, double* H_m, double* h_m, const oro::Progress& progress) {
    constexpr std::size_t block = 4096;
    const auto blocks = static_cast<int>((count + block - 1) / block);
    std::mutex telling;
    int done = 0;
    oro::in_parallel(blocks, oro::thread_count(), [&](int number) {
        const std::size_t first = static_cast<std::size_t>(number) * block;
        for (std::size_t i = first; i < std::min(count, first + block); ++i) {
            const oro::ProfilePoint point = oro::profile_point(ground, {lat_deg[i], lon_deg[i], 0.0}, 0.0);
            constexpr double none = std::numeric_limits<double>::quiet_NaN();
            if (H_m != nullptr) H_m[i] = point.has_ground ? point.H_m : none;
            if (h_m != nullptr) h_m[i] = point.has_ground ? point.h_m : none;
        }
        if (!progress) return;
        const std::lock_guard lock(telling);
        progress(static_cast<double>(++done) / blocks, "finding heights");
    });
}

}  // namespace

oro_status oro_error_code(void) {
    return oro::last_status();
}

const char* oro_error_text(void) {
    return oro::last_text();
}

const char* oro_version(void) {
    return OROGRAPH_VERSION;
}

int oro_api_version(void) {
    return ORO_API_VERSION;
}

oro_status oro_open(const char* const* paths, size_t count, const oro_open_options* options,
                    oro_progress progress, void* user, oro_region* region) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("region", region));
        *region = 0;
        AskedRegion asked;
        if (options != nullptr) {
            ORO_TRY(asked, asked_region(*options));
        }
        ORO_TRY(asked.region.paths, oro::strings_of("paths", paths, count));
        if (asked.region.paths.empty()) return oro::bad_argument("paths", "names no file");
        oro::find_library_data();
        ORO_TRY(auto opened,
                oro::open_for_library(asked.region, asked.cover, oro::progress_to(progress, user)));
        *region = oro::keep_open(std::move(opened));
        return {};
    });
}

oro_status oro_close(oro_region region) {
    return oro::guarded_call([&] { return oro::close_region(region); });
}

oro_status oro_info(oro_region region, char* text, size_t capacity, size_t* length) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("length", length));
        ORO_TRY(const auto open, oro::region_of(region));
        ORO_TRY(const std::string info, info_text_of(*open));
        return oro::give_text(info, text, capacity, length);
    });
}

oro_status oro_grid_crs(oro_region region, size_t grid, char* text, size_t capacity, size_t* length) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_CHECK(oro::check_given("length", length));
        ORO_TRY(const auto open, oro::region_of(region));
        const auto& grids = open->ground->region.grids;
        if (grid >= grids.size())
            return oro::bad_argument(
                "grid", std::to_string(grid) + " is not among the region's " + std::to_string(grids.size()));
        const auto& crs = grids[grid].posts_crs;
        return oro::give_text(crs ? crs->wkt : "EPSG:4326", text, capacity, length);
    });
}

oro_status oro_heights(oro_region region, size_t count, const double* lat_deg, const double* lon_deg,
                       double* H_m, double* h_m) {
    return oro_heights_with_progress(region, count, lat_deg, lon_deg, H_m, h_m, nullptr, nullptr);
}

oro_status oro_heights_with_progress(oro_region region, size_t count, const double* lat_deg,
                                     const double* lon_deg, double* H_m, double* h_m, oro_progress progress,
                                     void* user) {
    return oro::guarded_call([&]() -> Result<void> {
        ORO_TRY(const auto open, oro::region_of(region));
        if (count == 0) return {};
        ORO_CHECK(oro::check_given("lat_deg", lat_deg));
        ORO_CHECK(oro::check_given("lon_deg", lon_deg));
        if (H_m == nullptr && h_m == nullptr) return oro::bad_argument("H_m and h_m", "are both NULL");
        constexpr std::size_t most = std::size_t{1} << 40U;
        if (count > most) return oro::bad_argument("count", std::to_string(count) + " is more than 2^40");
        for (std::size_t i = 0; i < count; ++i)
            ORO_CHECK(oro::check_place("place", lat_deg[i], lon_deg[i], static_cast<std::ptrdiff_t>(i)));
        find_heights(open->ground->ground(), count, lat_deg, lon_deg, H_m, h_m,
                     oro::progress_to(progress, user));
        return open->ground->region.health();
    });
}
