#include "geo/files/unread_formats.h"

#include "geo/files/file_begin.h"
#include "geo/files/letter_case.h"

namespace oro {
namespace {

// Whether the first bytes of a file of XML hold CityGML's first element, which has a prefix of any name.
bool begins_as_citygml(const std::string& path) {
    const std::string head = begin_of_file(path, 4096);
    return head.find("<CityModel") != std::string::npos || head.find(":CityModel") != std::string::npos;
}

}  // namespace

std::string why_unread(const std::string& name, const std::string& path) {
    const std::string lower = lower_case(name);
    constexpr const char* citygml = "CityGML is not read; citygml-tools turns it into CityJSON";
    for (const char* const ending : {".gml", ".citygml"})
        if (lower.ends_with(ending)) return std::string("is GML: ") + citygml;
    if (lower.ends_with(".xml") && begins_as_citygml(path)) return citygml;
    for (const char* const ending : {".las", ".laz", ".e57"})
        if (lower.ends_with(ending))
            return "is a point cloud, and these are not read: make a raster of its ground points (GeoTIFF; "
                   "PDAL's writers.gdal does), or a mesh (.ply, .obj)";
    return "";
}

}  // namespace oro
