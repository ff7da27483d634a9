#include "geo/sources/raster_source.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "geo/datum/proj_operations.h"
#include "geo/datum/vertical_datum.h"
#include "geo/files/foreign_text.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"
#include "geo/files/unread_formats.h"
#include "geo/sources/elevation_band.h"
#include "geo/sources/height_unit.h"
#include "geo/sources/raster_content.h"
#include "geo/sources/raster_crs.h"
#include "geo/sources/raster_parts.h"
#include "geo/sources/raster_place.h"

namespace oro {
namespace {

std::string text_of(const char* text) {
    return text ? foreign_text(text) : "";
}

// What heights refer to: by the CRS, by DTED metadata, as told, or assumed.
StatedDatum read_vertical(Source& source, GDALDatasetH dataset, OGRSpatialReferenceH crs,
                          const SourceOverrides& overrides) {
    if (OSRIsCompound(crs) || OSRGetAxesCount(crs) == 3) {
        source.vertical_crs = wkt_of(crs);
        if (auto datum = stated_datum(source.vertical_crs)) {
            source.report.vertical_datum = {DatumFrom::crs, datum->name, false};
            return *datum;
        }
        // Kept: who asks for it later is told that it cannot be read.
        source.report.vertical_datum.from = DatumFrom::assumed_unreadable;
        return {};
    }
    const std::string dted = text_of(GDALGetMetadataItem(dataset, "DTED_VerticalDatum", nullptr));
    if (dted == "E96" || dted == "E08") {
        source.vertical_crs = dted == "E96" ? "EPSG:4326+5773" : "EPSG:4326+3855";
        source.report.vertical_datum.from = dted == "E96" ? DatumFrom::dted_egm96 : DatumFrom::dted_egm2008;
        return {};
    }
    return overrides.heights_of(source);
}

std::string attribution_of(GDALDatasetH dataset) {
    std::string text;
    for (const char* item :
         {"TIFFTAG_COPYRIGHT", "TIFFTAG_ARTIST", "ATTRIBUTION", "attribution", "LICENSE"}) {
        const std::string value = text_of(GDALGetMetadataItem(dataset, item, nullptr));
        if (!value.empty() && text.find(value) == std::string::npos)
            text += (text.empty() ? "" : "; ") + value;
    }
    return text;
}

// Of text that starts with a mark of its encoding, which hides what it is from GDAL; "" for all else.
std::string mark_words(const std::string& file) {
    VSILFILE* const stream = VSIFOpenL(file.c_str(), "rb");
    if (stream == nullptr) return "";
    std::string head(3, '\0');
    head.resize(VSIFReadL(head.data(), 1, head.size(), stream));
    VSIFCloseL(stream);
    const bool utf8 = head == "\xef\xbb\xbf";
    if (!utf8 && !head.starts_with("\xff\xfe") && !head.starts_with("\xfe\xff")) return "";
    return std::string("starts with a byte order mark (its text is ") + (utf8 ? "UTF-8" : "UTF-16") +
           "), which hides its format: save it as plain text (ASCII), without a mark";
}

// That PROJ has no database where it is told to look, on which all else depends; "" if it has.
std::string lacks_database() {
    const ProjContext context = new_proj_context();
    if (!context || proj_context_get_database_path(context.get()) != nullptr) return "";
    const char* variable = "PROJ_DATA";
    const char* folder = std::getenv(variable);
    if (folder == nullptr) folder = std::getenv(variable = "PROJ_LIB");
    if (folder == nullptr) return "PROJ finds no proj.db, its database, on this machine (package proj-data)";
    return std::string("PROJ finds no proj.db, its database, in ") + foreign_text(folder) + ", which " +
           variable + " names";
}

struct Opened {
    Dataset dataset;  // null when it is no raster that is read here
    Error unfit;      // then
    RasterParts parts;
};

// True when a file that cannot be opened is damaged, rather than something else: by its name or first bytes.
bool should_open(const SourcePath& path) {
    const std::string name = lower_case(path.name);
    for (const char* ending : {".tif", ".tiff", ".gtiff", ".jp2", ".vrt", ".dt0", ".dt1", ".dt2"}) {
        if (name.ends_with(ending)) return true;
    }
    return GDALIdentifyDriverEx(path.file.c_str(), GDAL_OF_RASTER, trusted_drivers(), nullptr) != nullptr;
}

// Whether a GeoPackage holds no raster of heights: such one names their kind near its beginning.
bool is_geopackage_of_vectors(const std::string& name, const std::string& file) {
    constexpr std::size_t looked_at = std::size_t{1} << 20U;
    VSILFILE* const stream = name.ends_with(".gpkg") ? VSIFOpenL(file.c_str(), "rb") : nullptr;
    if (stream == nullptr) return false;
    std::string head(looked_at, '\0');
    head.resize(VSIFReadL(head.data(), 1, head.size(), stream));
    VSIFCloseL(stream);
    return head.starts_with("SQLite format 3") && head.find("gpkg_geometry_columns") != std::string::npos &&
           head.find("2d-gridded-coverage") == std::string::npos;
}

// What a file that is no raster is for, by its name; "" where that says nothing.
std::string use_of_other_file(const SourcePath& path) {
    const std::string name = lower_case(path.name);
    const bool is_of_vectors = is_geopackage_of_vectors(name, path.file);
    for (const char* const ending : {".gpx", ".geojson", ".topojson", ".kml", ".kmz", ".csv", ".shp", ".fgb"})
        if (is_of_vectors || name.ends_with(ending))
            return "holds no elevation raster but tracks, points or areas: --overlay draws them, --names "
                   "reads "
                   "names of places, --mesh-file puts surfaces and buildings on the terrain";
    return why_unread(name, path.file);
}

Result<Opened> open_source(const SourcePath& path, const GdalMessages& messages) {
    Opened opened;
    ORO_TRY(opened.parts, parts_of_raster(path.file));
    if (!opened.parts.unfit.empty()) {
        opened.unfit = {ErrorKind::failed, "", opened.parts.unfit};
        return opened;
    }
    opened.dataset.reset(GDALOpenEx(path.file.c_str(),
                                    GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                    trusted_drivers(), nullptr, nullptr));
    if (!opened.dataset) {
        if (should_open(path))
            return Error{ErrorKind::failed, "",
                         "cannot be opened as a raster: " + messages.last("unknown format")};
        std::string why = mark_words(path.file);
        if (why.empty()) why = use_of_other_file(path);
        if (why.empty())
            why = "is not a raster in an accepted format (" + trusted_formats() +
                  "): in others a file that is cut short may pass unnoticed; gdal_translate converts them to "
                  "GeoTIFF";
        opened.unfit = {ErrorKind::failed, "", std::move(why)};
        return opened;
    }
    const CPLStringList listed(GDALGetFileList(opened.dataset.get()));
    for (int i = 0; i < listed.size(); ++i) {
        const std::string file = local_file_of(listed[i]);
        if (std::ranges::find(opened.parts.files, file) == opened.parts.files.end())
            opened.parts.files.push_back(file);
    }
    return opened;
}

// What an opened raster says of itself; an error without its name where it is no source.
// `doubts` get what a user must know of it.
Result<Source> described(const SourcePath& path, const Opened& opened, const SourceOverrides& overrides,
                         std::vector<std::string>& doubts) {
    const Dataset& dataset = opened.dataset;
    const auto fault = [&](const std::string& what) { return Error{ErrorKind::failed, "", what}; };
    ORO_TRY(const ElevationBand band, elevation_band(dataset.get()));
    std::array<double, 6> cell{};
    const bool says_where = GDALGetGeoTransform(dataset.get(), cell.data()) == CE_None;
    const OGRSpatialReferenceH stated = GDALGetSpatialRef(dataset.get());
    const bool lacks_crs = stated ? OSRIsLocal(stated) != 0 : GDALGetGCPCount(dataset.get()) == 0;
    if (lacks_crs && overrides.crs.empty())
        return fault(without_crs(stated ? text_of(OSRGetName(stated)) : "",
                                 says_where ? std::optional(cell) : std::nullopt,
                                 GDALGetRasterXSize(dataset.get()), GDALGetRasterYSize(dataset.get())));
    ORO_TRY(const SpatialReference crs,
            lacks_crs ? Result<SpatialReference>(crs_from_text(overrides.crs)) : crs_of(dataset.get()));
    if (!says_where) return fault("states no georeference: where its posts lie is unknown");
    Source source;
    source.kind = SourceKind::raster;
    source.file = path.file;
    source.named = path.named;
    source.band = band.band;
    source.signed_bytes = band.signed_bytes;
    if (!band.doubt.empty()) doubts.push_back(band.doubt);
    source.report.path = path.shown;
    source.report.driver = text_of(GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get())));
    source.report.rows = GDALGetRasterYSize(dataset.get());
    source.report.columns = GDALGetRasterXSize(dataset.get());
    if (source.report.rows < 2 || source.report.columns < 2) return fault("has fewer than 2 x 2 posts");
    const StatedDatum datum = read_vertical(source, dataset.get(), crs.get(), overrides);
    const SpatialReference horizontal = horizontal_part(crs.get());
    ORO_CHECK(read_height_unit(source, dataset.get(),
                               {datum, horizontal.get(), overrides.height_unit, opened.parts.files}, doubts));
    // GDAL's map is for the corners of cells, whatever AREA_OR_POINT says (it has moved "point" files by half
    // a cell); a post is a cell's centre.
    source.crs_from_post = {cell[0] + 0.5 * (cell[1] + cell[2]), cell[1], cell[2],
                            cell[3] + 0.5 * (cell[4] + cell[5]), cell[4], cell[5]};
    const bool points =
        lower_case(text_of(GDALGetMetadataItem(dataset.get(), "AREA_OR_POINT", nullptr))) == "point";
    source.report.posts_are = points ? PostsAre::points : PostsAre::cell_centres;
    source.report.attribution = attribution_of(dataset.get());
    source.crs_specified = lacks_crs;
    source.report.crs = crs_name(horizontal.get()) + (lacks_crs ? " (as told)" : "");
    if (const double epoch = OSRGetCoordinateEpoch(crs.get()); epoch > 0.0)
        source.report.horizontal_datum.coordinate_epoch = epoch;
    source.crs_wkt = wkt_of(horizontal.get());
    ORO_CHECK(place_on_earth(source, horizontal.get()));
    ORO_CHECK(check_place(source, horizontal.get(), doubts));
    return source;
}

// Whole numbers of 0 to 255 that nothing calls heights.
bool is_of_bytes(const Source& source, GDALDatasetH dataset) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, source.band);
    if (GDALGetRasterDataType(band) != GDT_Byte || source.signed_bytes) return false;
    if (source.scale_m != 1.0 || source.offset_m != 0.0) return false;
    const DatumFrom datum = source.report.vertical_datum.from;
    if (datum == DatumFrom::crs) return false;
    // A datum that a product's name brings, or that was told, says nothing of what this file holds, and
    // neither does the unit that comes with it.
    const bool datum_from_outside = datum == DatumFrom::product || datum == DatumFrom::specified;
    const bool unit_is_assumed =
        source.report.height_unit.from == UnitFrom::assumed ||
        (datum_from_outside && source.report.height_unit.from == UnitFrom::file &&
         text_of(GDALGetRasterUnitType(band)).empty() && !geotiff_heights(source.file).vertical_unit);
    return unit_is_assumed;
}

}  // namespace

Result<Finding> inspect_raster(const SourcePath& path, const SourceOverrides& overrides) {
    start_gdal();
    const GdalMessages messages;
    const FileWatch watch(opening_limit_s);
    const auto named = [&](Error error) {
        error.where = error.where.empty() ? path.shown : path.shown + ": " + error.where;
        return error;
    };
    const auto opened = open_source(path, messages);
    if (!watch.fault().empty()) return named({ErrorKind::failed, "", watch.fault()});
    if (!opened) return named(opened.error());
    Finding finding;
    if (!opened->dataset) {
        finding.unfit = named(opened->unfit);
        return finding;
    }
    std::vector<std::string> doubts;
    auto source = described(path, *opened, overrides, doubts);
    if (!watch.fault().empty()) return named({ErrorKind::failed, "", watch.fault()});
    if (!source) {
        if (const std::string lack = lacks_database(); !lack.empty())
            return named({ErrorKind::failed, "", lack});
        finding.unfit = named(source.error());
        if (finding.unfit.kind == ErrorKind::usage) return finding.unfit;
        return finding;
    }
    std::string holds = holds_by_tags(opened->dataset.get());
    if (holds.empty()) holds = holds_by_name_and_values(path.name, opened->dataset.get());
    if (!holds.empty()) {
        finding.unfit = named({ErrorKind::failed, "", "holds " + holds + ", no elevation"});
        finding.companion = true;
        return finding;
    }
    finding.source = std::move(*source);
    finding.source->bytes = is_of_bytes(*finding.source, opened->dataset.get());
    finding.source->report.files = opened->parts.files;
    doubts.insert(doubts.begin(), opened->parts.doubts.begin(), opened->parts.doubts.end());
    for (const std::string& doubt : doubts) finding.doubts.push_back(path.shown + ": " + doubt);
    if (const std::string warning = messages.warning(); !warning.empty())
        finding.doubts.push_back(path.shown + ": GDAL warns: " + warning);
    return finding;
}

}  // namespace oro
