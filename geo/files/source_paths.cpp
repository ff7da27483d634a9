#include "geo/files/source_paths.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <tuple>

#include "geo/files/archive_entries.h"
#include "geo/files/letter_case.h"
#include "geo/files/network_paths.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view made_prefix = "made:";

std::string_view last_part(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? path : path.substr(slash + 1);
}

// Endings of raster formats that elevation is commonly kept in; GDAL decides what the file really is.
bool may_hold_elevation(std::string_view name) {
    static constexpr std::array endings{".hgt", ".tif", ".tiff", ".gtiff", ".vrt", ".img",
                                        ".bil", ".flt", ".asc",  ".bt",    ".dem", ".dt0",
                                        ".dt1", ".dt2", ".nc",   ".grd",   ".jp2", ".ter"};
    const std::string lower = lower_case(name);
    if (lower.starts_with("._")) return false;  // resource forks that archives from macOS carry
    if (lower == "w001001.adf") return true;
    return std::ranges::any_of(endings, [&](const char* ending) { return lower.ends_with(ending); });
}

enum class Wrapping { none, zip, tar, gzip };
Wrapping wrapping_of(std::string_view name) {
    const std::string lower = lower_case(name);
    if (lower.ends_with(".zip")) return Wrapping::zip;
    if (lower.ends_with(".tar") || lower.ends_with(".tgz") || lower.ends_with(".tar.gz"))
        return Wrapping::tar;
    if (lower.ends_with(".gz")) return Wrapping::gzip;
    return Wrapping::none;
}

SourcePath described(std::string file, std::string shown, std::string_view name, bool named) {
    SourcePath source;
    source.file = std::move(file);
    source.shown = std::move(shown);
    source.name = std::string(name);
    source.hgt = lower_case(name).ends_with(".hgt");
    source.named = named;
    return source;
}

class Search {
  public:
    // Where errors of files in folders go; null: they end the search.
    explicit Search(std::vector<Error>* unreadable) : unreadable_(unreadable) {}

    Result<void> add(const std::string& path) {
        if (path.starts_with(made_prefix)) {
            // No file: geo/sources/made_words.h reads the text.
            found_.push_back(described(path, path, path, true));
            found_.back().hgt = false;
            return {};
        }
        if (is_network_path(path)) {
            if (!are_network_paths_allowed()) return network_path_refused(path);
            found_.push_back(described(path, path, last_part(path), true));
            return {};
        }
        std::error_code fault;
        const fs::file_status status = fs::status(path, fault);
        if (status.type() == fs::file_type::not_found) {
            const bool link = fs::is_symlink(fs::symlink_status(path, fault));
            return Error{ErrorKind::failed, path,
                         link ? "is a symbolic link to nothing" : "no such file or folder"};
        }
        if (fault) return Error{ErrorKind::failed, path, fault.message()};
        const std::size_t before = found_.size();
        if (status.type() == fs::file_type::directory) {
            ORO_CHECK(add_folder(path));
            if (found_.size() == before && (unreadable_ == nullptr || unreadable_->empty()))
                return Error{ErrorKind::no_data, path,
                             "no elevation data under this folder (no .hgt, GeoTIFF or other raster, also "
                             "not in .zip or .gz)"};
            return {};
        }
        return add_file(path, true);
    }

    // The same, and keeps the path's number with what it finds.
    Result<void> add_path(const std::string& path, std::size_t number) {
        const std::size_t before = found_.size();
        ORO_CHECK(add(path));
        for (std::size_t i = before; i < found_.size(); ++i) found_[i].path = number;
        return {};
    }

    std::vector<SourcePath> take() {
        // A file reached in two ways is one source, and a named one when any way names it.
        std::ranges::sort(found_, [](const SourcePath& a, const SourcePath& b) {
            return std::tie(a.file, b.named) < std::tie(b.file, a.named);
        });
        for (std::size_t i = 1; i < found_.size(); ++i)
            if (found_[i].file == found_[i - 1].file)
                found_[i].path = found_[i - 1].path = std::min(found_[i].path, found_[i - 1].path);
        // Not std::ranges::unique: what it returns is beyond clang 14, with which the fuzzers are built.
        found_.erase(std::unique(found_.begin(), found_.end(),
                                 [](const SourcePath& a, const SourcePath& b) { return a.file == b.file; }),
                     found_.end());
        std::ranges::sort(found_, [](const SourcePath& a, const SourcePath& b) {
            return std::tie(a.name, a.shown) < std::tie(b.name, b.shown);
        });
        return std::move(found_);
    }

  private:
    Result<void> add_folder(const std::string& path) {
        std::error_code fault;
        fs::recursive_directory_iterator place(path, fault);
        if (fault) return Error{ErrorKind::failed, path, "cannot be listed: " + fault.message()};
        for (; place != fs::recursive_directory_iterator(); place.increment(fault)) {
            std::error_code no_file;
            if (place->is_directory(no_file)) continue;
            // What is no file, or cannot be asked about, is told by add_file where its name says elevation.
            const Result<void> added = add_file(place->path().string(), false);
            if (added.ok()) continue;
            if (unreadable_ == nullptr) return added;
            unreadable_->push_back(added.error());
        }
        if (fault) return Error{ErrorKind::failed, path, "cannot be listed: " + fault.message()};
        return {};
    }

    Result<void> add_file(const std::string& path, bool named) {
        const std::string_view name = last_part(path);
        const Wrapping wrapping = wrapping_of(name);
        const std::string_view inner = wrapping == Wrapping::gzip ? name.substr(0, name.size() - 3) : name;
        const bool archive = wrapping == Wrapping::zip || wrapping == Wrapping::tar;
        if (!named && !archive && !may_hold_elevation(inner)) return {};
        std::error_code fault;
        const fs::file_status status = fs::status(path, fault);
        if (status.type() == fs::file_type::not_found && fs::is_symlink(fs::symlink_status(path, fault)))
            return Error{ErrorKind::failed, path, "is a symbolic link to nothing"};
        if (fault) return Error{ErrorKind::failed, path, "cannot be read: " + fault.message()};
        if (status.type() != fs::file_type::regular)
            return Error{ErrorKind::failed, path, "is no regular file"};
        if (access(path.c_str(), R_OK) != 0)
            return Error{ErrorKind::failed, path,
                         "cannot be read: " + std::generic_category().message(errno)};
        // The real path, absolute: no name can then mean anything else to GDAL, and a file found twice is
        // told.
        const std::string real = fs::canonical(path, fault).string();
        if (fault) return Error{ErrorKind::failed, path, "cannot be read: " + fault.message()};
        if (archive) return add_archive(real, path, wrapping, named);
        const std::string file = wrapping == Wrapping::gzip ? "/vsigzip/" + real : real;
        found_.push_back(described(file, path, inner, named));
        return {};
    }

    Result<void> add_archive(const std::string& real, const std::string& shown, Wrapping wrapping,
                             bool named) {
        const ArchiveKind kind = wrapping == Wrapping::zip ? ArchiveKind::zip : ArchiveKind::tar;
        const std::string root = (kind == ArchiveKind::zip ? "/vsizip/{" : "/vsitar/{") + real + "}/";
        ORO_TRY(const std::vector<ArchiveEntry> entries, archive_entries(real, shown, kind));
        bool any = false;
        for (const ArchiveEntry& entry : entries) {
            const std::string_view name = last_part(entry.name);
            if (!may_hold_elevation(name)) continue;
            if (!entry.unreadable.empty()) {
                const Error locked{ErrorKind::failed, shown + "/" + entry.name, entry.unreadable};
                if (named || unreadable_ == nullptr) return locked;
                unreadable_->push_back(locked);
                continue;
            }
            SourcePath source = described(root + entry.name, shown + "/" + entry.name, name, false);
            source.archive = std::string(last_part(shown));
            found_.push_back(std::move(source));
            any = true;
        }
        if (named && !any)
            return Error{ErrorKind::no_data, shown,
                         "no elevation data in this archive (no .hgt, GeoTIFF or other raster)"};
        return {};
    }

    std::vector<Error>* unreadable_;
    std::vector<SourcePath> found_;
};

Result<std::vector<SourcePath>> searched(const std::vector<std::string>& paths,
                                         std::vector<Error>* unreadable) {
    start_gdal();
    Search search(unreadable);
    try {
        for (std::size_t i = 0; i < paths.size(); ++i) ORO_CHECK(search.add_path(paths[i], i));
    } catch (const fs::filesystem_error& fault) {
        return Error{ErrorKind::failed, fault.path1().string(), fault.code().message()};
    }
    return search.take();
}

}  // namespace

Result<std::vector<SourcePath>> find_sources(const std::vector<std::string>& paths) {
    return searched(paths, nullptr);
}

Result<std::vector<SourcePath>> find_sources(const std::vector<std::string>& paths,
                                             std::vector<Error>& unreadable) {
    return searched(paths, &unreadable);
}

}  // namespace oro
