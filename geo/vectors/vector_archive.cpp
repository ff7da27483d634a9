#include "geo/vectors/vector_archive.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <span>
#include <system_error>

#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/vectors/vector_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// KML is packed to a tenth or a thirtieth of its length; what unpacks to so many times its own was made to.
constexpr std::uint64_t most_times_unpacked = 200;
constexpr std::uint64_t most_unpacked_bytes_unasked = std::uint64_t{16} << 20U;
constexpr std::size_t most_names_shown = 3;

Error archive_fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// Whether a name in an archive is a path to somewhere else.
bool leads_out(const std::string& name) {
    const fs::path path(name);
    return path.is_absolute() || name.find('\\') != std::string::npos ||
           std::ranges::find(path, fs::path("..")) != path.end();
}

// A resource fork that an archive from macOS carries: it only has the name of another file.
bool is_resource_fork(const std::string& name) {
    return fs::path(name).filename().string().starts_with("._");
}

bool has_ending(const ArchiveEntry& entry, std::span<const char* const> endings) {
    const std::string lower = lower_case(entry.name);
    return !is_resource_fork(entry.name) &&
           std::ranges::any_of(endings, [&](const char* ending) { return lower.ends_with(ending); });
}

// Whether a link begins with the scheme of a URI, as in "https:". Source: RFC 3986, section 3.1.
bool has_scheme(const std::string& href) {
    const std::size_t colon = href.find(':');
    return colon != std::string::npos && href.find('/') > colon;
}

// A link's path: without what stands behind #, with the bytes that %20 and the like stand for.
std::string path_of_link(const std::string& href) {
    const std::string_view link = std::string_view(href).substr(0, href.find('#'));
    std::string path;
    for (std::size_t at = 0; at < link.size(); ++at) {
        unsigned byte = 0;
        const char* const digits = link.data() + at + 1;
        if (link[at] == '%' && at + 2 < link.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            path += static_cast<char>(byte);
            at += 2;
        } else {
            path += link[at];
        }
    }
    return path;
}

std::string some_names(const std::vector<const ArchiveEntry*>& entries) {
    std::string names;
    for (std::size_t i = 0; i < std::min(entries.size(), most_names_shown); ++i)
        names += (i > 0 ? ", " : "") + foreign_text(entries[i]->name);
    return names + (entries.size() > most_names_shown ? " ..." : "");
}

}  // namespace

Result<VectorArchive> VectorArchive::open(const std::string& file) {
    auto entries = archive_entries(file, file, ArchiveKind::zip);
    if (!entries.ok()) return archive_fault(entries.error().what);
    return VectorArchive(file, std::move(*entries));
}

const ArchiveEntry* VectorArchive::named(const std::string& name) const {
    const auto found = std::ranges::find(entries_, name, &ArchiveEntry::name);
    return found == entries_.end() ? nullptr : &*found;
}

const ArchiveEntry* VectorArchive::main_kml() const {
    if (const ArchiveEntry* const main = named("doc.kml"); main != nullptr) return main;
    const std::vector<const ArchiveEntry*> all = all_kml();
    return all.empty() ? nullptr : all.front();
}

std::vector<const ArchiveEntry*> VectorArchive::all_kml() const {
    static constexpr std::array kml{".kml"};
    std::vector<const ArchiveEntry*> all;
    for (const ArchiveEntry& entry : entries_)
        if (has_ending(entry, kml)) all.push_back(&entry);
    return all;
}

Result<const ArchiveEntry*> VectorArchive::only_vector_file() const {
    static constexpr std::array vectors{".shp", ".gpkg", ".fgb", ".geojson", ".topojson", ".gpx"};
    // Texts that are often about others.
    static constexpr std::array texts{".csv", ".json"};
    std::vector<const ArchiveEntry*> found;
    for (const std::span<const char* const> endings : {std::span<const char* const>(vectors), {texts}}) {
        if (!found.empty()) break;
        for (const ArchiveEntry& entry : entries_)
            if (has_ending(entry, endings)) found.push_back(&entry);
    }
    if (found.empty())
        return archive_fault(
            "is packed and holds no .kml, .shp, .gpkg, .fgb, .geojson, .topojson, .gpx or .csv: unpack it "
            "and name what is in it");
    if (found.size() > 1)
        return archive_fault("is packed and holds " + std::to_string(found.size()) + " vector files (" +
                             some_names(found) + "): unpack it and name one of them");
    return found.front();
}

const ArchiveEntry* VectorArchive::beside(const ArchiveEntry& entry, std::string_view ending) const {
    const std::string stem = fs::path(entry.name).replace_extension().string();
    const auto found = std::ranges::find_if(entries_, [&](const ArchiveEntry& one) {
        return one.name.size() == stem.size() + ending.size() && one.name.starts_with(stem) &&
               lower_case(one.name).ends_with(ending);
    });
    return found == entries_.end() ? nullptr : &*found;
}

const ArchiveEntry* VectorArchive::linked(const ArchiveEntry& from, const std::string& href) const {
    // Names are written as they are, too, without the escapes of a URI.
    for (const std::string& path : {href, path_of_link(href)}) {
        if (path.empty() || has_scheme(path) || leads_out(path)) continue;
        const ArchiveEntry* const found =
            named((fs::path(from.name).parent_path() / path).lexically_normal().string());
        if (found != nullptr && lower_case(found->name).ends_with(".kml")) return found;
    }
    return nullptr;
}

Result<std::string> VectorArchive::unpack(const ArchiveEntry& entry) {
    const std::string shown = foreign_text(entry.name),
                      which = shown + (unpacked_bytes_ > 0 ? ", which with the files before it" : ", which");
    if (leads_out(entry.name))
        return archive_fault("holds " + shown + ", whose name leads out of the archive: it is not opened");
    if (const auto count = std::ranges::count(entries_, entry.name, &ArchiveEntry::name); count > 1)
        return archive_fault("holds " + std::to_string(count) + " files of the name " + shown +
                             ", and which of them counts is not clear: unpack it and name the file");
    if (entry.bytes > longest_vector_text - unpacked_bytes_)
        return archive_fault("holds " + which + " is longer than 1 GiB, the limit");
    const std::uint64_t bytes = unpacked_bytes_ + entry.bytes;
    std::error_code failed;
    const std::uintmax_t packed = fs::file_size(file_, failed);
    if (bytes > most_unpacked_bytes_unasked && (failed || bytes / most_times_unpacked > packed))
        return archive_fault("holds " + which + " would unpack to more than " +
                             std::to_string(most_times_unpacked) +
                             " times the archive's length: it is not unpacked");
    auto all = unpacked(file_, file_, entry);
    if (!all.ok()) return archive_fault(shown + " " + all.error().what);
    unpacked_bytes_ = bytes;
    return std::move(*all);
}

}  // namespace oro
