#include "geo/vectors/vector_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <utility>

#include "core/base/open_file.h"
#include "geo/drape/placed_raster.h"
#include "geo/files/archive_entries.h"
#include "geo/files/foreign_text.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"
#include "geo/files/text_encoding.h"
#include "geo/vectors/vector_readers.h"
#include "geo/vectors/vector_shapes.h"
#include "geo/vectors/xml_text.h"

namespace oro {
namespace {

constexpr std::size_t features_between_looks = 256;

Error fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// What the first bytes and the size of a file say.
struct Look {
    enum class Form { text, database, packed };
    Form form{Form::text};
    std::uint64_t bytes{};
};

std::uint64_t size_or_0(const std::string& file) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    return failed ? 0 : size;
}

Result<Look> probe(const std::string& file, std::vector<std::string>& notes) {
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
    if (text.starts_with(std::string_view("PK\3\4", 4))) look.form = Look::Form::packed;
    for (const auto& [mark, packer] : {std::pair{std::string_view("\x1f\x8b", 2), "gzip"},
                                       {std::string_view("BZh", 3), "bzip2"},
                                       {std::string_view("\xfd"
                                                         "7zXZ\0",
                                                         6),
                                        "xz"},
                                       {std::string_view("\x28\xb5\x2f\xfd", 4), "zstd"},
                                       {std::string_view("7z\xbc\xaf", 4), "7-Zip"}})
        if (text.starts_with(mark)) return fault(std::string("is packed with ") + packer + ": unpack it");
    if (text == std::string_view("SQLite format 3\0", 16)) look.form = Look::Form::database;
    if (look.form == Look::Form::text && look.bytes > longest_vector_text)
        return fault("is longer than 1 GiB, which is the limit; a GeoPackage may be longer");
    if (look.form != Look::Form::database) return look;
    if (size_or_0(file + "-journal") > 0)
        return fault("was left half written (its -journal is there): open it once with what wrote it");
    if (size_or_0(file + "-wal") > 0)
        notes.push_back(file + ": its -wal file holds changes that are not read; close what has it open");
    return look;
}

// What a file gave, when all of it was looked at. Errors: nothing that could be drawn.
Result<void> ended(VectorFile& file, const LeftOut& left_out, std::string_view text) {
    for (std::string& note : left_out.notes(file.file, text)) file.notes.push_back(std::move(note));
    file.places_left_out = left_out.places();
    if (!file.layers.empty()) return {};
    return fault("holds no points, lines or polygons" +
                 (left_out.empty() ? "" : "; left out: " + left_out.words(text)));
}

struct FreeFeature {
    void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, FreeFeature>;

// A database while it is read.
class Reading {
  public:
    Reading(GDALDatasetH dataset, FileWatch& watch, const GdalMessages& messages, VectorFile& file)
        : dataset_(dataset), watch_(watch), messages_(messages), file_(file) {}

    Result<void> all() {
        for (int i = 0; i < GDALDatasetGetLayerCount(dataset_); ++i) {
            const OGRLayerH layer = GDALDatasetGetLayer(dataset_, i);
            if (layer != nullptr) ORO_CHECK(read_layer(layer));
        }
        return ended(file_, left_out_, "");
    }

  private:
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
        file_.ring_ends += splitter->ring_ends();
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
        const HeightAbove heights =
            splitter.heights() == HeightAbove::nothing ? HeightAbove::sea_level : splitter.heights();
        splitter.split(geometry, {heights, layer.records.size(), &layer.shapes, &left_out_});
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

    GDALDatasetH dataset_;
    FileWatch& watch_;
    const GdalMessages& messages_;
    VectorFile& file_;
    LeftOut left_out_;
    std::size_t places_{};
};

Result<void> read_database(VectorFile& file, FileWatch& watch, const GdalMessages& messages) {
    // Nothing is written beside a database, and what it lists is all that is looked at.
    static constexpr std::array<const char*, 3> whole{"IMMUTABLE=YES", "LIST_ALL_TABLES=NO", nullptr};
    const Dataset dataset(GDALOpenEx(file.file.c_str(),
                                     GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                     database_vector_drivers(), whole.data(), nullptr));
    if (!dataset)
        return fault("is not a vector file in an accepted format (" + trusted_vector_formats() +
                     "): " + messages.last("unknown format"));
    // OGR goes on with WGS84 where it does not know a CRS.
    if (!messages.last("").empty()) return fault("cannot be read: " + messages.last(""));
    return Reading(dataset.get(), watch, messages, file).all();
}

Result<std::string> bytes_of_file(const std::string& name) {
    ORO_TRY(const OpenFile opened, OpenFile::open(name, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, opened.size());
    std::string bytes(size, '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

// KML's main file in a packed one: doc.kml, or the first that there is.
Result<std::string> bytes_of_kmz(const std::string& name) {
    const auto in_one_line = [](const Error& error) { return fault(error.what); };
    const auto entries = archive_entries(name, name, ArchiveKind::zip);
    if (!entries.ok()) return in_one_line(entries.error());
    const auto is_kml = [](const ArchiveEntry& entry) { return lower_case(entry.name).ends_with(".kml"); };
    auto main = std::ranges::find(*entries, "doc.kml", &ArchiveEntry::name);
    if (main == entries->end()) main = std::ranges::find_if(*entries, is_kml);
    if (main == entries->end()) return fault("is packed and holds no .kml: unpack it and name what is in it");
    if (main->bytes > longest_vector_text)
        return fault("holds " + foreign_text(main->name) + ", which is longer than 1 GiB, the limit");
    const auto bytes = unpacked(name, name, *main);
    if (!bytes.ok()) return in_one_line(bytes.error());
    return *bytes;
}

// What a file of text holds: its root says which format it has.
Result<void> read_text(VectorFile& file, std::string bytes, FileWatch& watch) {
    const auto unknown = [](const std::string& why) {
        return fault("is not a vector file in an accepted format (" + trusted_vector_formats() + "): " + why);
    };
    const std::string stem = std::filesystem::path(file.file).stem().string();
    ORO_TRY(const std::string text, utf8_xml(std::move(bytes)));
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    LeftOut left_out;
    if (first != std::string::npos && text[first] == '<') {
        const Result<XmlText> xml = XmlText::parse(text);
        if (!xml.ok()) return fault(xml.error().what);
        const std::string_view root = local_name(xml->root());
        static constexpr std::array kml_roots{"kml", "Document", "Folder", "Placemark"};
        if (root == "gpx") {
            ORO_CHECK(read_gpx(*xml, text, watch, file, left_out));
        } else if (std::ranges::find(kml_roots, root) != kml_roots.end()) {
            ORO_CHECK(read_kml(*xml, stem, watch, file, left_out));
        } else {
            return unknown("is XML whose first element is '" + foreign_text(root) + "'");
        }
    } else {
        const Result<void> read = read_geojson(text, stem, watch, file, left_out);
        if (!read.ok())
            return first != std::string::npos && (text[first] == '{' || text[first] == '[')
                       ? read
                       : unknown("unknown format");
    }
    return ended(file, left_out, text);
}

Result<void> read_all(VectorFile& file, const Look& look, FileWatch& watch, const GdalMessages& messages) {
    if (look.form == Look::Form::database) return read_database(file, watch, messages);
    const bool is_packed = look.form == Look::Form::packed;
    Result<std::string> bytes = is_packed ? bytes_of_kmz(file.file) : bytes_of_file(file.file);
    if (!bytes.ok()) return fault(bytes.error().what);
    return read_text(file, std::move(*bytes), watch);
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
    const Result<Look> look = probe(name, file.notes);
    if (!look.ok()) return with_name(look.error());
    FileWatch watch(limit_s + static_cast<double>(look->bytes >> 20U));
    const Result<void> read = read_all(file, *look, watch, messages);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, name, watch.fault()};
    if (!read.ok()) return with_name(read.error());
    ORO_TRY(file.fingerprint, files_fingerprint({name}));
    return file;
}

}  // namespace oro
