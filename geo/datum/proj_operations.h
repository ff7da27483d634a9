// PROJ as this program uses it for heights: a context without network or chatter, and the ways from one
// vertical datum to another with the grids that they need.
#pragma once

#include <proj.h>

#include <memory>
#include <string>
#include <vector>

#include "geo/region/region.h"

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
