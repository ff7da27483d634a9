// The line that a profile goes along.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/places/geodesic.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Places, each joined to the next by the shortest way over the ellipsoid.
struct LineAlong {
    std::vector<LatLon> places;        // two or more, not all one
    std::vector<double> distances_m;   // of each from the first, along the line
    std::vector<double> bearings_deg;  // from each but the last to the next, true, where the way begins
    std::string file;                  // that it was read from; "" of places on the command line
    std::vector<std::string> notes;    // what a user must know, one line each
};

// From the value of --along: a file, or places with ; between them. `number`: which line of a file, from 1.
// Errors: text that is neither, places that are none, one place alone (usage); those of read_vectors(), a
// file without a line, or with several and no number (usage).
Result<LineAlong> line_along(const std::string& text, const std::optional<int>& number);
// The same of a file alone; `option` is what errors call it beside its name.
Result<LineAlong> line_of_file(const std::string& option, const std::string& file,
                               const std::optional<int>& number);

// The line through places, of which there are two or more; `option` is what errors call it. Errors (usage):
// no length.
Result<LineAlong> line_through(const std::string& option, std::vector<LatLon> places);

// The names of a file's lines, in the order of their numbers: what the field "name" says, or "line 3".
std::vector<std::string> names_of_lines(const VectorFile& file);

// The place so far along the line; on_leg: of the way from place `leg` to the next, which it is on.
LatLon place_on_line(const LineAlong& line, double along_m);
LatLon place_on_leg(const LineAlong& line, std::size_t leg, double along_m);

}  // namespace oro
