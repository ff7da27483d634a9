// From paths and a bounding box to one region: which sources there are, what they say of themselves, and the
// height field that they make together.
#pragma once

#include <cstddef>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"

namespace oro {

// Reads a region, or opens a baked one: the way from files to posts.
//     RegionRequest request;
//     request.paths = {"jacksboro.tif"};
//     request.box = BoundingBox{-84.3, 36.5, -84.2, 36.6};  // west, south, east, north
//     ORO_TRY(const Region region, open_region(request));
//     const float H_m = region.grids[0].field.H_at_post_m(0, 0);  // the north-west post, above the geoid
// Errors: a path that is not there or unreadable, a source that is
// damaged (file, place, value, reason), no data in the region (ErrorKind::no_data), a datum that cannot be
// honoured with strict_datum, a baked region beside other paths or with an option that was decided when it
// was baked (ErrorKind::usage).
Result<Region> open_region(const RegionRequest& request, const Progress& progress = {});

// How the meshes of a baked file are opened: with all their triangles; or without these, where the file has
// them group by group (PlacedMesh::streamed), unless a box or --cut-under has to know them.
enum class MeshReading { whole, streamed };
Result<Region> open_region(const RegionRequest& request, const Progress& progress, MeshReading meshes);

// open_region() for a bake: of meshes of more than some 250,000 triangles all that is of their size lies in
// scratch files in that folder, and stays there as long as the region. A further error: no room for them.
Result<Region> open_region_in_scratch(const RegionRequest& request, const Progress& progress,
                                      const std::string& folder);

// From now on the region that was opened last is kept, and open_region() gives a copy of it to whoever asks
// for the same while its files stay what they were: for one job after the other. Regions whose posts would
// take more than a quarter of the machine's memory are not kept. To be called by the thread that opens
// regions.
void keep_last_region();
// No longer: what was kept is given up.
void keep_no_region();
// How often open_region() has read a region since keep_last_region().
std::size_t regions_read();

}  // namespace oro
