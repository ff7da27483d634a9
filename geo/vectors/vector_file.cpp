#include "geo/vectors/vector_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <sys/stat.h>
#include <utf8.h>

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
#include "geo/vectors/shapefile_parts.h"
#include "geo/vectors/vector_readers.h"
#include "geo/vectors/vector_shapes.h"
#include "geo/vectors/xml_text.h"

namespace oro {
namespace {

// KML is packed to a tenth or a thirtieth of its length; what unpacks to so many times its own was made to.
constexpr std::uint64_t most_times_unpacked = 200;
constexpr std::uint64_t longest_prj = 65'536;
constexpr std::uint64_t most_unpacked_bytes_unasked = std::uint64_t{16} << 20U;

Error fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// What the first bytes and the size of a file say.
struct Look {
    enum class Form { text, database, packed, shapefile, flat };
    Form form{Form::text};
    std::uint64_t bytes{};
};

std::uint64_t size_or_0(const std::string& file) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(file, failed);
    return failed ? 0 : size;
}

// A shapefile is named by its .shp: of its other files the .shx begins as that does.
Result<void> check_is_whole_shapefile(const std::string& file, bool is_shapefile) {
    const std::string lower = lower_case(file);
    const auto ends = [&](const char* ending) { return lower.ends_with(ending); };
    if (!(is_shapefile && ends(".shx")) && !ends(".dbf") && !ends(".prj") && !ends(".cpg")) return {};
    return fault("is a part of a shapefile: name its .shp");
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
    if (text.starts_with(std::string_view("fgb\3fgb", 7))) look.form = Look::Form::flat;
    if (text.starts_with(std::string_view("\0\0\x27\x0a", 4))) look.form = Look::Form::shapefile;
    ORO_CHECK(check_is_whole_shapefile(file, look.form == Look::Form::shapefile));
    if (text == std::string_view("SQLite format 3\0", 16)) look.form = Look::Form::database;
    if (look.form == Look::Form::text && look.bytes > longest_vector_text)
        return fault("is longer than 1 GiB, which is the limit; a GeoPackage or FlatGeobuf may be longer");
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

Result<std::string> bytes_of_file(const std::string& name) {
    ORO_TRY(const OpenFile opened, OpenFile::open(name, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, opened.size());
    std::string bytes(size, '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

// Whether a name in an archive is a path to somewhere else.
bool leads_out(const std::string& name) {
    const std::filesystem::path path(name);
    return path.is_absolute() || name.find('\\') != std::string::npos ||
           std::ranges::find(path, std::filesystem::path("..")) != path.end();
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
    const std::string shown = foreign_text(main->name);
    if (leads_out(main->name))
        return fault("holds " + shown + ", whose name leads out of the archive: it is not opened");
    if (main->bytes > longest_vector_text)
        return fault("holds " + shown + ", which is longer than 1 GiB, the limit");
    if (const std::uint64_t packed = size_or_0(name);
        main->bytes > most_unpacked_bytes_unasked && main->bytes / most_times_unpacked > packed)
        return fault("holds " + shown + ", which would unpack to more than " +
                     std::to_string(most_times_unpacked) + " times the archive's length: it is not unpacked");
    const auto bytes = unpacked(name, name, *main);
    if (!bytes.ok()) return in_one_line(bytes.error());
    return *bytes;
}

constexpr const char* no_columns =
    "its first line names no columns of coordinates: a CSV has lat and lon, or WKT, or x and y (E and N) "
    "with a "
    "coordinate reference system";

bool may_be_csv(const std::string& name) {
    const std::string lower = lower_case(name);
    return lower.ends_with(".csv") || lower.ends_with(".tsv") || lower.ends_with(".txt");
}

// Text of a spreadsheet of old in UTF-8; as it is where the library cannot turn it.
std::string from_windows_1252(const std::string& text) {
    const GdalMessages unsaid;
    char* const turned = CPLRecode(text.c_str(), "CP1252", CPL_ENC_UTF8);
    std::string utf8 = turned != nullptr ? turned : text;
    CPLFree(turned);
    return utf8;
}

// The CRS of a table's .prj, on one line; "" where there is none, or where it is a shapefile's.
Result<std::string> crs_beside(VectorFile& file) {
    const std::string prj = std::filesystem::path(file.file).replace_extension(".prj").string();
    std::error_code failed;
    if (!std::filesystem::is_regular_file(prj, failed) || failed) return std::string();
    for (const char* const ending : {".shp", ".SHP"})
        if (std::filesystem::exists(std::filesystem::path(file.file).replace_extension(ending), failed))
            return std::string();
    if (size_or_0(prj) > longest_prj)
        return fault("its .prj is longer than " + std::to_string(longest_prj) + " bytes, which is the limit");
    ORO_TRY(std::string crs, bytes_of_file(prj));
    ORO_TRY(crs, utf8_text(std::move(crs)));
    for (char& c : crs)
        if (c == '\r' || c == '\n' || c == '\t') c = ' ';
    file.files.push_back(prj);
    return crs;
}

// What a file of text holds: its root says which format it has.
Result<void> read_text(VectorFile& file, std::string bytes, FileWatch& watch) {
    const auto unknown = [](const std::string& why) {
        return fault("is not a vector file in an accepted format (" + trusted_vector_formats() + "): " + why);
    };
    const std::string stem = std::filesystem::path(file.file).stem().string();
    ORO_TRY(std::string text, utf8_xml(std::move(bytes)));
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
    } else if (is_csv(text)) {
        if (!utf8::is_valid(text.begin(), text.end())) {
            text = from_windows_1252(text);
            file.notes.push_back(file.file + ": is no UTF-8 and is read as Windows-1252");
        }
        ORO_TRY(const std::string crs, crs_beside(file));
        ORO_CHECK(read_csv(text, stem, crs, watch, file, left_out));
    } else {
        const Result<void> read = read_geojson(text, stem, watch, file, left_out);
        if (!read.ok())
            return first != std::string::npos && (text[first] == '{' || text[first] == '[')
                       ? read
                       : unknown(may_be_csv(file.file) ? no_columns : "unknown format");
    }
    return ended(file, left_out, text);
}

// A file that OGR reads.
Result<void> read_with_ogr(VectorFile& file, DatasetFormat format, FileWatch& watch,
                           const GdalMessages& messages) {
    if (format == DatasetFormat::shapefile) {
        ORO_TRY(ShapefileParts parts, shapefile_parts(file.file));
        file.files = std::move(parts.files);
        for (std::string& note : parts.notes) file.notes.push_back(std::move(note));
    }
    LeftOut left_out;
    ORO_CHECK(read_dataset(format, watch, messages, file, left_out));
    return ended(file, left_out, "");
}

Result<void> read_all(VectorFile& file, const Look& look, FileWatch& watch, const GdalMessages& messages) {
    switch (look.form) {
        case Look::Form::database:
            return read_with_ogr(file, DatasetFormat::geopackage, watch, messages);
        case Look::Form::shapefile:
            return read_with_ogr(file, DatasetFormat::shapefile, watch, messages);
        case Look::Form::flat:
            return read_with_ogr(file, DatasetFormat::flatgeobuf, watch, messages);
        case Look::Form::text:
        case Look::Form::packed:
            break;
    }
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
    file.files = {name};
    const auto with_name = [&](const Error& error) { return Error{error.kind, name, error.what}; };
    const Result<Look> look = probe(name, file.notes);
    if (!look.ok()) return with_name(look.error());
    FileWatch watch(limit_s + static_cast<double>(look->bytes >> 20U));
    const Result<void> read = read_all(file, *look, watch, messages);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, name, watch.fault()};
    if (!read.ok()) return with_name(read.error());
    ORO_TRY(file.fingerprint, files_fingerprint(file.files));
    return file;
}

}  // namespace oro
