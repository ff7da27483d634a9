// The third step to a region: its sources' posts are laid into its grid.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/datum/vertical_datum.h"
#include "geo/posts/resampling_error.h"
#include "geo/posts/seams.h"
#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// What all sources are laid into.
struct MosaicTarget {
    const PostGrid& grid;
    const UndulationField& undulation;
    const GeoidOfRegion& geoid;
    bool strict_datum{};
};

// A source whose posts are not the region's, and how far the surface is from them; to be finished when the
// surface is.
struct MeasuredSource {
    std::size_t source;  // its number
    ResamplingError error;
};

// Reads all sources in their order of precedence, turns their heights into H and lays them into the surface.
// Each source's report gets what was found in it; `notes` what a user must know. Gives the sources that were
// resampled or interpolated; they, and what is given, belong to this surface's heights. Errors: damage in a
// source; a datum that cannot be honoured.
Result<std::vector<MeasuredSource>> mosaic_sources(std::vector<Source>& sources, const MosaicTarget& region,
                                                   JoinedSurface& surface, std::vector<std::string>& notes,
                                                   const Progress& progress);

// What a user must know of a source that was laid. lent: void posts of finer sources that it filled;
// beyond_grid: its posts outside the grids of its vertical datum. Errors, with strict: there are any of the
// latter.
Result<void> note_findings(SourceReport& report, std::uint64_t voids_filled, std::uint64_t beyond_grid,
                           bool strict, std::vector<std::string>& notes);

}  // namespace oro
