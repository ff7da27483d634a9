// A camera's path from its file: keys, a tour or a track.
#pragma once

#include <optional>
#include <vector>

#include "apps/commands/sight/line_along.h"
#include "apps/film/camera_path.h"
#include "apps/film/written_keys.h"
#include "apps/options/options.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/vectors/kml_tour.h"

namespace oro {

// What the path's file holds, before the region is open.
struct WrittenPath {
    std::vector<WrittenKey> keys;
    std::vector<TourStop> stops;
    std::optional<LineAlong> track;
};

// Reads options.path: a .json of keys, a .kml with a tour, else the line of a vector file. Errors: those of
// these files; options of tracks for what is none (usage).
Result<WrittenPath> read_path(const FilmOptions& options);
// Its keys over a region whose heights are exaggerated, all heights above the ellipsoid. Errors: those of
// track_flight(), keys_along_track(), keys_of_tour() and eyes_over_region().
Result<std::vector<CameraKey>> keys_of(const WrittenPath& path, const FilmOptions& options,
                                       const Region& region, double exaggeration);

}  // namespace oro
