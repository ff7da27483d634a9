// PROJ as this program uses it for datums: a context without network or chatter, and the ways from one
// datum to another with the grids that they need.
#pragma once

#include <proj.h>

#include <memory>
#include <string>
#include <vector>

#include "geo/places/bounding_box.h"

namespace oro {

struct FreeProjContext {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct FreeProjObject {
    void operator()(PJ* object) const { proj_destroy(object); }
};
using ProjContext = std::unique_ptr<PJ_CONTEXT, FreeProjContext>;
using ProjObject = std::unique_ptr<PJ, FreeProjObject>;

ProjContext new_proj_context();

// "EPSG:4267 NAD27"
std::string code_and_name(const PJ* object);
// A CRS without the wrapping that TOWGS84 parameters or a geoid model give it.
ProjObject unbound(PJ_CONTEXT* context, ProjObject crs);

struct OperationGrids {
    std::vector<std::string> paths;    // of those that are there, whole
    std::vector<std::string> missing;  // names of those that are not
    std::string names;                 // of all, joined
};
OperationGrids grids_of(PJ_CONTEXT* context, const PJ* operation);
// Grids that PROJ reads by itself are files that are read (core/base/files_read.h).
void remember_grids(const std::vector<std::string>& paths);

// All operations that PROJ knows for a box, best first, those that lack a grid last; ballpark ones leave out
// what they know no way for. None where a CRS is null. They must not outlive the context.
std::vector<ProjObject> operations_between(PJ_CONTEXT* context, const PJ* from, const PJ* to,
                                           const BoundingBox& unwrapped, bool with_ballpark);

// A way from heights of a CRS to heights above WGS84's ellipsoid.
struct LiftingOperation {
    ProjObject operation;  // longitude, latitude, height to WGS84's; null when there is no usable one
    std::vector<std::string> grids;  // files that it uses, by their whole paths
    std::string missing;             // names of the grids that the best unusable one lacks
    std::string unusable_grid;       // a file that is there and that PROJ can do nothing with
};
// Never one that leaves heights as they are for want of a better ("ballpark"). The operation must not outlive
// the context.
LiftingOperation find_lifting_operation(PJ_CONTEXT* context, const PJ* from, const BoundingBox& unwrapped);

// Names of files without their folders, joined by ", ".
std::string file_names(const std::vector<std::string>& paths);

// Lifts points in place; a point that the operation cannot take gets infinity.
void lift(PJ* operation, std::vector<double>& lon_deg, std::vector<double>& lat_deg, std::vector<double>& z);

// A file of PROJ's by one of these names that is there, where PROJ looks for its files: its whole path, or
// "".
std::string proj_file_there(PJ_CONTEXT* context, const std::vector<std::string>& names);

}  // namespace oro
