#include "geo/vectors/vector_file.h"

#include <cpl_conv.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <utility>

#include "core/base/open_file.h"
#include "geo/drape/image_source.h"
#include "geo/files/foreign_text.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/sources/raster_library.h"
#include "geo/vectors/geojson_crs.h"
#include "geo/vectors/vector_library.h"
#include "geo/vectors/vector_shapes.h"

namespace oro {
namespace {

constexpr std::size_t features_between_looks = 256;

Error fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// What the first bytes and the size of a file say, before OGR is asked.
struct Look {
    bool is_database{};
    std::uint64_t bytes{};
};

std::uint64_t size_or_0(const std::string& file) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    return failed ? 0 : size;
}

Result<Look> look_at(const std::string& file, std::vector<std::string>& notes) {
    struct stat status {};
    if (stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
        return fault(S_ISDIR(status.st_mode) ? "is a folder, not a vector file" : "is no regular file");
    ORO_TRY(const OpenFile opened, OpenFile::open(file, OpenFile::Use::read));
    Look look;
    ORO_TRY(look.bytes, opened.size());
    if (look.bytes == 0) return fault("is empty");
    std::array<std::byte, 16> head{};
    const std::span<std::byte> first =
        std::span(head).first(std::min<std::uint64_t>(head.size(), look.bytes));
    ORO_CHECK(opened.read(0, first));
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    if (text.starts_with(std::string_view("PK\3\4", 4)))
        return fault("is packed (KMZ?): unpack it and name what is in it");
    look.is_database = text == std::string_view("SQLite format 3\0", 16);
    if (!look.is_database && look.bytes > longest_vector_text)
        return fault("is longer than 1 GiB, which is the limit; a GeoPackage may be longer");
    if (look.is_database && size_or_0(file + "-journal") > 0)
        return fault("was left half written (its -journal is there): open it once with what wrote it");
    if (look.is_database && size_or_0(file + "-wal") > 0)
        notes.push_back(file + ": its -wal file holds changes that are not read; close what has it open");
    return look;
}

// An option of GDAL's for this thread, while it lives.
class ThreadOption {
  public:
    ThreadOption(const char* name, const char* value) : name_(name) {
        CPLSetThreadLocalConfigOption(name, value);
    }
    ~ThreadOption() { CPLSetThreadLocalConfigOption(name_, nullptr); }
    ThreadOption(const ThreadOption&) = delete;
    ThreadOption& operator=(const ThreadOption&) = delete;

  private:
    const char* name_;
};

struct FreeFeature {
    void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, FreeFeature>;

// One file while it is read.
class Reading {
  public:
    Reading(GDALDatasetH dataset, FileWatch& watch, const GdalMessages& messages, VectorFile& file)
        : dataset_(dataset), watch_(watch), messages_(messages), file_(file) {
        const std::string driver = GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
        is_gpx_ = driver == "GPX";
        is_kml_ = driver == "LIBKML";
        is_geojson_ = driver == "GeoJSON";
    }

    Result<void> all() {
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i) {
            const OGRLayerH layer = GDALDatasetGetLayer(dataset_, i);
            if (layer == nullptr || tells_again(OGR_L_GetName(layer))) continue;
            ORO_CHECK(read_layer(layer));
        }
        for (std::string& note : left_out_.notes(file_.file)) file_.notes.push_back(std::move(note));
        if (!file_.layers.empty()) return {};
        return fault("holds no points, lines or polygons" +
                     (left_out_.empty() ? "" : "; left out: " + left_out_.words()));
    }

  private:
    // GPX files give the places of their lines as points once more.
    [[nodiscard]] bool tells_again(const std::string& layer) const {
        return is_gpx_ && (layer == "route_points" || layer == "track_points");
    }

    Result<void> read_layer(OGRLayerH handle) {
        VectorLayer layer;
        layer.name = foreign_text(OGR_L_GetName(handle));
        const OGRFeatureDefnH definition = OGR_L_GetLayerDefn(handle);
        if (OGR_FD_GetGeomFieldCount(definition) == 0) {
            left_out_.add("layers without geometries");
            return {};
        }
        auto splitter = ShapeSplitter::of(OGR_L_GetSpatialRef(handle));
        if (!splitter.ok()) return fault("layer '" + layer.name + "': " + splitter.error().what);
        for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i)
            layer.fields.push_back(foreign_text(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i))));
        altitude_mode_ = is_kml_ ? layer.field_number("altitudeMode") : -1;
        OGR_L_ResetReading(handle);
        for (std::size_t count = 0;; ++count) {
            if (count % features_between_looks == 0 && watch_.spent()) return fault(watch_.fault());
            const Feature feature(OGR_L_GetNextFeature(handle));
            if (!feature) break;
            take(feature.get(), layer, *splitter);
            if (places_ + splitter->places() > most_vector_places)
                return fault("has more than " + std::to_string(most_vector_places) +
                             " places, which is the limit");
        }
        if (!messages_.last("").empty())
            return fault("layer '" + layer.name + "' cannot be read to its end: " + messages_.last(""));
        places_ += splitter->places();
        if (!layer.shapes.empty()) file_.layers.push_back(std::move(layer));
        return {};
    }

    void take(OGRFeatureH feature, VectorLayer& layer, ShapeSplitter& splitter) {
        const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
        if (geometry == nullptr) {
            left_out_.add("features without a geometry");
            return;
        }
        const std::size_t before = layer.shapes.size();
        splitter.split(geometry, heights_of(feature, splitter), layer.records.size(), layer.shapes,
                       left_out_);
        if (layer.shapes.size() > before) layer.records.push_back(record_of(feature, layer.fields.size()));
    }

    static VectorRecord record_of(OGRFeatureH feature, std::size_t fields) {
        VectorRecord record;
        for (std::size_t i = 0; i < fields; ++i) {
            const int number = static_cast<int>(i);
            if (OGR_F_IsFieldSetAndNotNull(feature, number) == 0) continue;
            std::string text = foreign_text(OGR_F_GetFieldAsString(feature, number));
            if (!text.empty()) record.push_back({i, std::move(text)});
        }
        return record;
    }

    [[nodiscard]] HeightAbove heights_of(OGRFeatureH feature, const ShapeSplitter& splitter) const {
        if (is_kml_) {
            const std::string mode =
                altitude_mode_ >= 0 ? OGR_F_GetFieldAsString(feature, altitude_mode_) : "";
            if (mode == "absolute") return HeightAbove::sea_level;
            return mode == "relativeToGround" ? HeightAbove::ground : HeightAbove::nothing;
        }
        if (is_gpx_) return HeightAbove::sea_level;
        if (splitter.heights() != HeightAbove::nothing) return splitter.heights();
        return is_geojson_ ? HeightAbove::ellipsoid : HeightAbove::sea_level;
    }

    GDALDatasetH dataset_;
    FileWatch& watch_;
    const GdalMessages& messages_;
    VectorFile& file_;
    bool is_gpx_{}, is_kml_{}, is_geojson_{};
    int altitude_mode_{-1};
    LeftOut left_out_;
    std::size_t places_{};
};

Result<void> read_all(VectorFile& file, const Look& look, FileWatch& watch, const GdalMessages& messages) {
    const ThreadOption heights("GPX_ELE_AS_25D", "YES");
    // Nothing is written beside a database, and what it lists is all that is looked at.
    static constexpr std::array<const char*, 3> whole{"IMMUTABLE=YES", "LIST_ALL_TABLES=NO", nullptr};
    const Dataset dataset(GDALOpenEx(file.file.c_str(),
                                     GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                     look.is_database ? database_vector_drivers() : text_vector_drivers(),
                                     look.is_database ? whole.data() : nullptr, nullptr));
    if (!dataset)
        return fault("is no vector file that can be opened here (" + trusted_vector_formats() +
                     "): " + messages.last("unknown format"));
    // OGR goes on with WGS84 where it does not know a CRS, and with nothing where XML ends too soon.
    if (!messages.last("").empty()) return fault("cannot be read: " + messages.last(""));
    if (!look.is_database) ORO_CHECK(check_geojson_crs(file.file, watch));
    return Reading(dataset.get(), watch, messages, file).all();
}

}  // namespace

int VectorLayer::field_number(std::string_view field) const {
    const auto exact = std::ranges::find(fields, field);
    const auto found = exact != fields.end() ? exact : std::ranges::find_if(fields, [&](const auto& one) {
        return lower_case(one) == lower_case(field);
    });
    return found == fields.end() ? -1 : static_cast<int>(found - fields.begin());
}

std::string_view VectorLayer::text(const VectorShape& shape, std::string_view field) const {
    const int number = field_number(field);
    if (number < 0) return "";
    for (const VectorField& one : records[shape.record]) {
        if (one.name == static_cast<std::size_t>(number)) return one.text;
    }
    return "";
}

std::size_t VectorFile::count(VectorKind kind) const {
    std::size_t all = 0;
    for (const VectorLayer& layer : layers)
        all += static_cast<std::size_t>(std::ranges::count(layer.shapes, kind, &VectorShape::kind));
    return all;
}

Result<VectorFile> read_vectors(const std::string& name, double limit_s) {
    start_vectors();
    const GdalMessages messages;
    VectorFile file;
    file.file = name;
    const auto with_name = [&](const Error& error) { return Error{error.kind, name, error.what}; };
    const Result<Look> look = look_at(name, file.notes);
    if (!look.ok()) return with_name(look.error());
    FileWatch watch(limit_s + static_cast<double>(look->bytes >> 20U));
    const Result<void> read = read_all(file, *look, watch, messages);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, name, watch.fault()};
    if (!read.ok()) return with_name(read.error());
    ORO_TRY(file.print, image_print({name}));
    return file;
}

}  // namespace oro
