#include "apps/fetch/tile_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <tuple>

#include "apps/report/json_text.h"
#include "apps/settings/user_folders.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t in_use_s = 3600;
constexpr const char* use_ending = ".used";

Result<fs::path> all_folder() {
    ORO_TRY(const fs::path cache, user_cache_folder());
    return cache / "fetched";
}

bool is_tile(const fs::path& file) {
    const std::string name = file.filename().string();
    return !name.ends_with(use_ending) && !name.ends_with(".part") && !name.ends_with(".part-etag") &&
           !name.starts_with('.');
}

// When a tile was last used: by the file beside it, else by its own time.
std::int64_t use_of(const std::string& file) {
    struct stat status {};
    if (stat((file + use_ending).c_str(), &status) != 0 && stat(file.c_str(), &status) != 0) return 0;
    return status.st_mtime;
}

Error unlisted(const fs::path& folder, const std::error_code& fault) {
    return {ErrorKind::failed, folder.string(), "cannot be listed: " + fault.message()};
}

}  // namespace

Result<std::string> tile_cache_folder(const std::string& source) {
    ORO_TRY(const fs::path all, all_folder());
    const fs::path folder = all / source;
    std::error_code fault;
    fs::create_directories(folder, fault);
    if (fault) return Error{ErrorKind::failed, folder.string(), "cannot be made: " + fault.message()};
    return folder.string();
}

Result<std::vector<CachedTile>> cached_tiles() {
    ORO_TRY(const fs::path all, all_folder());
    std::vector<CachedTile> tiles;
    std::error_code fault;
    if (!fs::exists(all, fault)) return tiles;
    fs::directory_iterator sources(all, fault);
    if (fault) return unlisted(all, fault);
    for (; sources != fs::directory_iterator(); sources.increment(fault)) {
        if (fault) return unlisted(all, fault);
        std::error_code unread;
        if (!sources->is_directory(unread)) continue;
        for (fs::directory_iterator files(sources->path(), unread);
             !unread && files != fs::directory_iterator(); files.increment(unread)) {
            std::error_code gone;
            if (!files->is_regular_file(gone) || !is_tile(files->path())) continue;
            const std::uintmax_t bytes = files->file_size(gone);
            if (gone) continue;
            const std::string file = files->path().string();
            tiles.push_back({sources->path().filename().string(), file, bytes, use_of(file)});
        }
        if (unread) return unlisted(sources->path(), unread);
    }
    std::ranges::sort(tiles, {}, [](const CachedTile& one) { return std::tie(one.used_utc_s, one.file); });
    return tiles;
}

void note_use(const std::string& file) {
    const std::string beside = file + use_ending;
    // Without it the tile's own time counts.
    const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) return;
    (void)futimens(descriptor, nullptr);
    ::close(descriptor);
}

Result<CacheTrimmed> trim_tile_cache(std::uint64_t limit_bytes) {
    ORO_TRY(const std::vector<CachedTile> tiles, cached_tiles());
    std::uint64_t bytes = 0;
    for (const CachedTile& tile : tiles) bytes += tile.bytes;
    CacheTrimmed trimmed;
    const std::int64_t now_s = time(nullptr);
    for (const CachedTile& tile : tiles) {
        if (bytes <= limit_bytes) break;
        if (now_s - tile.used_utc_s < in_use_s) continue;
        std::error_code fault;
        fs::remove(tile.file, fault);
        if (fault) return Error{ErrorKind::failed, tile.file, "cannot be removed: " + fault.message()};
        fs::remove(tile.file + use_ending, fault);
        bytes -= tile.bytes;
        ++trimmed.files;
        trimmed.bytes += tile.bytes;
    }
    return trimmed;
}

}  // namespace oro
