#include "geo/vectors/vector_crs.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/open_file.h"
#include "geo/drape/placed_raster.h"
#include "geo/files/foreign_text.h"
#include "geo/files/guarded_files.h"
#include "geo/files/letter_case.h"
#include "geo/files/memory_files.h"
#include "geo/files/raster_library.h"
#include "geo/files/text_encoding.h"
#include "geo/vectors/csv_records.h"
#include "geo/vectors/flatgeobuf_end.h"
#include "geo/vectors/shapefile_parts.h"
#include "geo/vectors/table_text.h"
#include "geo/vectors/vector_archive.h"
#include "geo/vectors/vector_readers.h"
#include "geo/vectors/vector_shapes.h"
#include "geo/vectors/xml_text.h"

namespace oro {
namespace {

constexpr std::uint64_t longest_prj = 65'536;
constexpr std::size_t most_linked_files = 64;  // beside the main one of a KMZ

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

// Takes what was left out of a text, or of a dataset, into a file's notes, which call it `shown`; gives it in
// one.
std::string noted(const LeftOut& left_out, const std::string& shown, std::string_view text,
                  VectorFile& file) {
    for (std::string& note : left_out.notes(shown, text)) file.notes.push_back(std::move(note));
    file.places_left_out += left_out.places();
    return left_out.words(text);
}

Result<std::string> bytes_of_file(const std::string& name) {
    ORO_TRY(const OpenFile opened, OpenFile::open(name, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, opened.size());
    std::string bytes(size, '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(bytes))));
    return bytes;
}

constexpr const char* no_columns =
    "its first line names no columns of coordinates: a CSV has lat and lon, or WKT, or x and y (E and N) "
    "with a coordinate reference system";

bool may_be_csv(const std::string& name) {
    const std::string lower = lower_case(name);
    return lower.ends_with(".csv") || lower.ends_with(".tsv") || lower.ends_with(".txt");
}

Result<void> check_length_of_prj(std::uint64_t bytes) {
    if (bytes <= longest_prj) return {};
    return fault("its .prj is longer than " + std::to_string(longest_prj) + " bytes, which is the limit");
}

// The CRS that a .prj holds, on one line.
Result<std::string> crs_of_prj(std::string bytes) {
    ORO_TRY(std::string crs, utf8_text(std::move(bytes)));
    for (char& c : crs)
        if (c == '\r' || c == '\n' || c == '\t') c = ' ';
    return crs;
}

// The CRS of a table's .prj; "" where there is none, or where it is a shapefile's.
Result<std::string> crs_beside(VectorFile& file) {
    const std::string prj = std::filesystem::path(file.file).replace_extension(".prj").string();
    std::error_code failed;
    if (!std::filesystem::is_regular_file(prj, failed) || failed) return std::string();
    for (const char* const ending : {".shp", ".SHP"})
        if (std::filesystem::exists(std::filesystem::path(file.file).replace_extension(ending), failed))
            return std::string();
    ORO_CHECK(check_length_of_prj(size_or_0(prj)));
    ORO_TRY(std::string bytes, bytes_of_file(prj));
    ORO_TRY(std::string crs, crs_of_prj(std::move(bytes)));
    file.files.push_back(prj);
    return crs;
}

// The same of a table in an archive.
Result<std::string> crs_in_archive(VectorArchive& archive, const ArchiveEntry& table) {
    const ArchiveEntry* const prj = archive.beside(table, ".prj");
    if (prj == nullptr) return std::string();
    ORO_CHECK(check_length_of_prj(prj->bytes));
    ORO_TRY(std::string bytes, archive.unpack(*prj));
    return crs_of_prj(std::move(bytes));
}

// A text of vectors: that of a file, or of one in an archive.
struct VectorText {
    std::string name;   // of its file; without its ending that of its layer, where the text has none
    std::string shown;  // what notes call it
    std::string bytes;
    KmlLinks links;
    std::function<Result<std::string>()> crs_of_table;
};

// GPX and KML are in WGS84, whatever is asked.
Result<void> check_is_of_wgs84(const VectorCrs& asked, std::string_view root) {
    if (asked.crs.empty()) return {};
    ORO_TRY(const ShapeSplitter splitter, splitter_of_words(asked.crs));
    if (splitter.is_of_wgs84()) return {};
    return fault(std::string(root == "gpx" ? "GPX" : "KML") +
                 " is in latitudes and longitudes of WGS84, not in " + asked.crs);
}

// Reads what a text holds: its root says which format it has. Gives what was left out.
Result<std::string> read_text(VectorText from, const VectorCrs& asked, VectorFile& file, FileWatch& watch) {
    const auto unknown = [](const std::string& why) {
        return fault("is not a vector file in an accepted format (" + trusted_vector_formats() + "): " + why);
    };
    const std::string stem = std::filesystem::path(from.name).stem().string();
    ORO_TRY(std::string text, utf8_xml(std::move(from.bytes)));
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    LeftOut left_out;
    if (first != std::string::npos && text[first] == '<') {
        const Result<XmlText> xml = XmlText::parse(text);
        if (!xml.ok()) return fault(xml.error().what);
        const std::string_view root = local_name(xml->root());
        static constexpr std::array kml_roots{"kml", "Document", "Folder", "Placemark"};
        ORO_CHECK(check_is_of_wgs84(asked, root));
        if (root == "gpx") {
            ORO_CHECK(read_gpx(*xml, text, watch, file, left_out));
        } else if (std::ranges::find(kml_roots, root) != kml_roots.end()) {
            ORO_CHECK(read_kml(*xml, stem, from.links, watch, file, left_out));
        } else {
            return unknown("is XML whose first element is '" + foreign_text(root) + "'");
        }
    } else if (const bool may_be_json =
                   first != std::string::npos && (text[first] == '{' || text[first] == '[');
               is_csv(text) || (!may_be_json && may_be_csv(from.name))) {
        ORO_TRY(TableText table, utf8_table(std::move(text)));
        text = std::move(table.text);
        if (!table.note.empty()) file.notes.push_back(from.shown + ": " + table.note);
        if (!is_csv(text)) {
            const Result<CsvRecords> records = CsvRecords::of(text);
            return records.ok() ? unknown(no_columns) : records.error();
        }
        ORO_TRY(const std::string crs, from.crs_of_table());
        ORO_CHECK(read_csv(text, stem, crs, asked, watch, file, left_out));
    } else {
        const Result<void> read = read_geojson(text, stem, asked, watch, file, left_out);
        if (!read.ok()) return may_be_json ? read.error() : unknown("unknown format");
    }
    return noted(left_out, from.shown, text, file);
}

// Reads a file that OGR reads, by the name by which GDAL opens it. Gives what was left out.
Result<std::string> read_with_ogr(const std::string& name, DatasetFormat format, const VectorCrs& asked,
                                  VectorFile& file, FileWatch& watch, const GdalMessages& messages) {
    if (format == DatasetFormat::shapefile) {
        ORO_TRY(ShapefileParts parts, shapefile_parts(name, file.file, asked.crs.empty()));
        if (name == file.file) file.files = std::move(parts.files);
        for (std::string& note : parts.notes) file.notes.push_back(std::move(note));
    }
    if (format == DatasetFormat::flatgeobuf) ORO_CHECK(check_flatgeobuf_end(name));
    LeftOut left_out;
    ORO_CHECK(read_dataset(name, format, asked, watch, messages, file, left_out));
    return noted(left_out, file.file, "", file);
}

// An error of a file in an archive.
Error of_entry(const ArchiveEntry& entry, const Error& error) {
    return fault(foreign_text(entry.name) + ": " + error.what);
}

std::size_t places_in(const VectorFile& file) {
    std::size_t places = 0;
    for (const VectorLayer& layer : file.layers)
        for (const VectorShape& shape : layer.shapes)
            for (const auto& path : shape.paths) places += path.size();
    return places;
}

// Which .kml of a KMZ are not read, and why; one line each.
std::vector<std::string> unread_words(const VectorArchive& archive,
                                      const std::vector<const ArchiveEntry*>& read,
                                      const std::set<std::string>& beyond) {
    std::vector<std::string> words;
    if (!beyond.empty())
        words.push_back("links to more than " + std::to_string(most_linked_files) +
                        " files in it, which is the limit: " + std::to_string(beyond.size()) +
                        " are not read, the first by name is " + foreign_text(*beyond.begin()));
    std::vector<const ArchiveEntry*> unread = archive.all_kml();
    std::erase_if(unread, [&](const ArchiveEntry* one) {
        return std::ranges::find(read, one) != read.end() || beyond.contains(one->name);
    });
    if (unread.size() == 1)
        words.push_back("1 .kml in it is not read, since nothing links to it: " +
                        foreign_text(unread.front()->name));
    if (unread.size() > 1)
        words.push_back(std::to_string(unread.size()) +
                        " .kml in it are not read, since nothing links to them, the first is " +
                        foreign_text(unread.front()->name));
    return words;
}

// Reads the main file of a KMZ, and those that network links lead to within it, each once.
Result<std::string> read_kmz(VectorArchive& archive, const ArchiveEntry& main, const VectorCrs& asked,
                             VectorFile& file, FileWatch& watch) {
    std::vector<const ArchiveEntry*> entries{&main};
    std::set<std::string> beyond;  // the limit: files that are linked and not read
    std::string left_out;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const ArchiveEntry& entry = *entries[i];
        VectorText text{file.file, file.file, "", {}, [&] { return crs_in_archive(archive, entry); }};
        if (i > 0) text.name = entry.name, text.shown += "/" + foreign_text(entry.name);
        text.links = [&](const std::string& href) {
            const ArchiveEntry* const linked = archive.linked(entry, href);
            if (linked == nullptr) return false;
            const bool is_known = std::ranges::find(entries, linked) != entries.end();
            if (!is_known && entries.size() > most_linked_files)
                beyond.insert(linked->name);
            else if (!is_known)
                entries.push_back(linked);
            return true;
        };
        ORO_TRY(text.bytes, archive.unpack(entry));
        const Result<std::string> read = read_text(std::move(text), asked, file, watch);
        if (!read.ok()) return i == 0 ? read.error() : of_entry(entry, read.error());
        if (!read->empty()) left_out += (left_out.empty() ? "" : "; ") + *read;
        if (places_in(file) > most_vector_places)
            return fault("has more than " + std::to_string(most_vector_places) +
                         " places, which is the limit");
    }
    for (const std::string& words : unread_words(archive, entries, beyond)) {
        file.notes.push_back(file.file + ": " + words);
        left_out += (left_out.empty() ? "" : "; ") + words;
    }
    return left_out;
}

Result<std::string> read_packed_text(VectorArchive& archive, const ArchiveEntry& entry,
                                     const VectorCrs& asked, VectorFile& file, FileWatch& watch) {
    VectorText text{entry.name, file.file, "", {}, [&] { return crs_in_archive(archive, entry); }};
    ORO_TRY(text.bytes, archive.unpack(entry));
    const Result<std::string> read = read_text(std::move(text), asked, file, watch);
    return read.ok() ? read : of_entry(entry, read.error());
}

// It is unpacked into memory, with the other files of a shapefile.
Result<std::string> read_packed_dataset(VectorArchive& archive, const ArchiveEntry& entry,
                                        DatasetFormat format, const VectorCrs& asked, VectorFile& file,
                                        FileWatch& watch, const GdalMessages& messages) {
    const std::filesystem::path path(entry.name);
    const std::string stem = path.stem().string();
    MemoryFiles memory;
    ORO_TRY(std::string bytes, archive.unpack(entry));
    const std::string name = memory.add(stem + lower_case(path.extension().string()), std::move(bytes));
    for (const char* const ending : {".shx", ".dbf", ".prj", ".cpg"}) {
        const ArchiveEntry* const part = archive.beside(entry, ending);
        if (format != DatasetFormat::shapefile || part == nullptr) continue;
        ORO_TRY(std::string bytes_of_part, archive.unpack(*part));
        memory.add(stem + ending, std::move(bytes_of_part));
    }
    const Result<std::string> read = read_with_ogr(name, format, asked, file, watch, messages);
    return read.ok() ? read : of_entry(entry, read.error());
}

Result<std::string> read_packed(const VectorCrs& asked, VectorFile& file, FileWatch& watch,
                                const GdalMessages& messages) {
    ORO_TRY(VectorArchive archive, VectorArchive::open(file.file));
    if (const ArchiveEntry* const main = archive.main_kml(); main != nullptr)
        return read_kmz(archive, *main, asked, file, watch);
    ORO_TRY(const ArchiveEntry* const only, archive.only_vector_file());
    for (const auto& [ending, format] : {std::pair{".shp", DatasetFormat::shapefile},
                                         {".gpkg", DatasetFormat::geopackage},
                                         {".fgb", DatasetFormat::flatgeobuf}})
        if (lower_case(only->name).ends_with(ending))
            return read_packed_dataset(archive, *only, format, asked, file, watch, messages);
    return read_packed_text(archive, *only, asked, file, watch);
}

// Gives what was left out.
Result<std::string> read_all(const VectorCrs& asked, VectorFile& file, const Look& look, FileWatch& watch,
                             const GdalMessages& messages) {
    switch (look.form) {
        case Look::Form::database:
            return read_with_ogr(file.file, DatasetFormat::geopackage, asked, file, watch, messages);
        case Look::Form::shapefile:
            return read_with_ogr(file.file, DatasetFormat::shapefile, asked, file, watch, messages);
        case Look::Form::flat:
            return read_with_ogr(file.file, DatasetFormat::flatgeobuf, asked, file, watch, messages);
        case Look::Form::packed:
            return read_packed(asked, file, watch, messages);
        case Look::Form::text:
            break;
    }
    VectorText text{file.file, file.file, "", {}, [&] { return crs_beside(file); }};
    Result<std::string> bytes = bytes_of_file(file.file);
    if (!bytes.ok()) return fault(bytes.error().what);
    text.bytes = std::move(*bytes);
    return read_text(std::move(text), asked, file, watch);
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
    return read_vectors_in(name, {}, limit_s);
}

Result<VectorFile> read_vectors_in(const std::string& name, const VectorCrs& asked, double limit_s) {
    start_vectors();
    const GdalMessages messages;
    VectorFile file;
    file.file = name;
    file.files = {name};
    const auto with_name = [&](const Error& error) { return Error{error.kind, name, error.what}; };
    const Result<Look> look = probe(name, file.notes);
    if (!look.ok()) return with_name(look.error());
    FileWatch watch(limit_s + static_cast<double>(look->bytes >> 20U));
    const Result<std::string> left_out = read_all(asked, file, *look, watch, messages);
    if (!watch.fault().empty()) return Error{ErrorKind::failed, name, watch.fault()};
    if (!left_out.ok()) return with_name(left_out.error());
    if (file.layers.empty())
        return Error{ErrorKind::failed, name,
                     "holds no points, lines or polygons" +
                         (left_out->empty() ? std::string() : "; left out: " + *left_out)};
    ORO_TRY(file.fingerprint, files_fingerprint(file.files));
    return file;
}

}  // namespace oro
