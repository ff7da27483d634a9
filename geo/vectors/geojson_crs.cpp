#include "geo/vectors/vector_readers.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "geo/files/foreign_text.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

JsonValue member_of(const JsonValue& object, std::string_view name, const JsonValue& otherwise) {
    for (const auto& [known, value] : object.members()) {
        if (known == name) return value;
    }
    return otherwise;
}

Error unknown_crs(const std::string& words) {
    return {ErrorKind::failed, "",
            "names a coordinate reference system that PROJ does not know (" + foreign_text(words) + ")"};
}

}  // namespace

Result<ShapeSplitter> splitter_of_geojson(const JsonValue& root) {
    static constexpr std::string_view nothing = "null";
    const JsonValue absent(nothing, 0);
    const JsonValue crs = member_of(root, "crs", absent);
    if (crs.is(JsonValue::Kind::null)) return ShapeSplitter::of_wgs84();
    const JsonValue properties = member_of(crs, "properties", absent);
    if (const std::string link = member_of(properties, "href", absent).text(); !link.empty())
        return Error{ErrorKind::failed, "",
                     "names " + foreign_text(link) +
                         " as its coordinate reference system, and links are not followed"};
    std::string words;
    for (const char* const name : {"name", "urn"}) {
        if (words.empty()) words = member_of(properties, name, absent).text();
    }
    const JsonValue code = member_of(properties, "code", absent);
    if (words.empty() && !code.is(JsonValue::Kind::null)) words = "EPSG:" + code.words();
    return words.empty() ? Result<ShapeSplitter>(unknown_crs(std::string(crs.source())))
                         : splitter_of_words(words);
}

Result<ShapeSplitter> splitter_as_asked(const VectorCrs& asked, VectorFile& file,
                                        const std::function<Result<ShapeSplitter>()>& stated) {
    ORO_TRY(ShapeSplitter splitter, asked.crs.empty() ? stated() : splitter_of_words(asked.crs));
    if (!asked.unit_m) return splitter;
    const double scale = splitter.take_unit(*asked.unit_m);
    if (scale == 1.0) return splitter;
    char text[120];
    std::snprintf(text, sizeof text, "its coordinates are taken times %.9g, from its unit to that of the CRS",
                  scale);
    const std::string note = file.file + ": " + text;
    if (std::ranges::find(file.notes, note) == file.notes.end()) file.notes.push_back(note);
    return splitter;
}

Result<ShapeSplitter> splitter_of_words(const std::string& words) {
    OGRSpatialReference reference;
    {
        const GdalMessages unsaid;
        // No files and no network.
        const std::array<const char*, 3> limits{"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
        if (reference.SetFromUserInput(words.c_str(), limits.data()) != OGRERR_NONE)
            return unknown_crs(words);
    }
    // Whatever order the CRS has, files write x before y and longitude before latitude.
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return ShapeSplitter::of(OGRSpatialReference::ToHandle(&reference));
}

}  // namespace oro
