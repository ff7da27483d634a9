// Servers that find named places in a box: those of the Overpass API, which search OpenStreetMap.
// Source: https://wiki.openstreetmap.org/wiki/Overpass_API/Overpass_QL
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/places/bounding_box.h"

namespace oro {

// In `query`, {south}, {west}, {north} and {east} stand for the sides of the box, in degrees.
struct PlacesSource {
    std::string name;  // as --source takes it
    std::string title;
    std::string url;             // http or https: the address of the interpreter
    std::string query;           // in Overpass QL, with the answer as JSON
    std::uint64_t most_bytes{};  // a larger answer is refused
    std::string licence;
    std::string attribution;
    std::string page;  // where its makers describe it
};

// What is wrong with the address of a server, in words: no http or https, no server, a user or a password; ""
// where nothing is.
std::string fault_of_address(const std::string& url);

// What is wrong with a source, in words: its address, a query without the four sides of the box; "" where
// nothing is.
std::string fault_of(const PlacesSource& source);

// The boxes that together are these and do not cross the antimeridian. Errors (usage): they have more than
// `most_deg2` square degrees together, which a public server is not to be asked for.
Result<std::vector<BoundingBox>> boxes_to_ask(const std::vector<BoundingBox>& boxes, double most_deg2);

// The address that asks for the places in a box that does not cross the antimeridian.
std::string url_of(const PlacesSource& source, const BoundingBox& box);

}  // namespace oro
