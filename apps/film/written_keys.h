// Keys of a camera's path as files write them: the heights of their eyes may count from the ground.
#pragma once

#include <string>
#include <vector>

#include "apps/film/camera_path.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// A key whose eye's h_m counts from what `heights` says until eyes_over_region() has seen it; `nothing` is
// the ground, too.
struct WrittenKey {
    CameraKey key;
    HeightAbove heights{HeightAbove::ellipsoid};
};

// A film has so many keys at most.
inline constexpr std::size_t most_keys = 1'000'000;

// The keys of a path in JSON:
//     {"orograph_path": 1,
//      "keys": [{"time_s": 0, "eye": {"lat_deg": 46.6, "lon_deg": 8, "H_m": 3000}, "heading_deg": 90}, ...]}
// An eye's height is h_m (above the ellipsoid), H_m (above sea level) or above_m (over the ground).
// pitch_deg, roll_deg (0), fov_deg (usual_fov_deg) and utc ("2026-06-21T05:30:00Z") may be left out. `where`
// is what errors call the text. Errors: what is missing or wrong, with the number of the key from 1; times
// that do not ascend.
Result<std::vector<WrittenKey>> keys_from_json(const std::string& text, const std::string& where,
                                               double usual_fov_deg);
// The other way, all heights above the ellipsoid, every number with all its digits.
std::string keys_to_json(const std::vector<CameraKey>& keys);

// How high above the ellipsoid a place is whose height counts from what `heights` says, over a region whose
// heights are exaggerated. `where` is what errors call the path. Errors: no ground at a place over the
// ground, with the data's box (no_data).
Result<double> h_over_region(const Geodetic& written, HeightAbove heights, const Region& region,
                             double exaggeration, const std::string& where);

// Whether a film can have these keys. Errors (usage): an eye beyond view_limits::eye_h_m; a time of more than
// 10,000,000 s.
Result<void> check_keys(const std::vector<CameraKey>& keys, const std::string& where);

// The keys with heights above the ellipsoid, over a region whose heights are exaggerated. Errors: those
// of h_over_region() and check_keys().
Result<std::vector<CameraKey>> eyes_over_region(const std::vector<WrittenKey>& keys, const Region& region,
                                                double exaggeration, const std::string& where);

}  // namespace oro
