#include "geo/tilesets/kept_tiles.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>
#include <type_traits>

#include "geo/files/plain_file.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr const char* key_name = "tileset.key";
constexpr const char* tile_ending = ".tile";

// What a file begins with, as it lies in memory; the bytes of the glTF follow.
struct Header {
    std::array<char, 8> magic{'O', 'R', 'O', 'T', 'I', 'L', 'E', '1'};
    std::uint64_t has_content{}, triangles{}, bytes{};
    double error_m{};
    TileBox box;
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 11 * sizeof(double));

Result<std::vector<std::uint8_t>> bytes_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file.is_open() || file.bad()) return Error{ErrorKind::failed, path, "cannot be read"};
    return bytes;
}

// Under a name of this process until it is whole.
Result<void> write_whole(const std::string& path, std::span<const std::uint8_t> bytes) {
    const std::string temporary = path + "." + std::to_string(getpid());
    std::error_code failed;
    fs::remove(temporary, failed);
    ORO_CHECK(write_plain_file(temporary, bytes));
    fs::rename(temporary, path, failed);
    if (failed) return Error{ErrorKind::failed, path, "cannot be written: " + failed.message()};
    return {};
}

}  // namespace

std::string KeptTiles::path_of(const TileIndex& tile) const {
    return folder_ + "/" + std::to_string(tile.level) + "-" + std::to_string(tile.row) + "-" +
           std::to_string(tile.column) + tile_ending;
}

Result<KeptTiles> KeptTiles::open(const std::string& folder, const std::string& key) {
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed || !fs::is_directory(folder))
        return Error{ErrorKind::failed, folder, "cannot be made: " + failed.message()};
    const std::string path = folder + "/" + key_name;
    if (!fs::exists(path)) {
        if (!fs::is_empty(folder, failed))
            return Error{ErrorKind::failed, folder,
                         "holds something else than tiles of an export: move it away"};
        ORO_CHECK(write_whole(path, {reinterpret_cast<const std::uint8_t*>(key.data()), key.size()}));
    }
    ORO_TRY(const std::vector<std::uint8_t> known, bytes_of_file(path));
    if (std::string(known.begin(), known.end()) != key)
        return Error{ErrorKind::failed, folder,
                     "holds tiles of other data, options or another version of the program: remove it"};
    return KeptTiles(folder);
}

bool KeptTiles::has(const TileIndex& tile) const {
    std::error_code ignored;
    return fs::exists(path_of(tile), ignored);
}

Result<std::optional<KeptTile>> KeptTiles::read(const TileIndex& tile) const {
    if (!has(tile)) return std::optional<KeptTile>();
    const std::string path = path_of(tile);
    ORO_TRY(const std::vector<std::uint8_t> bytes, bytes_of_file(path));
    Header header;
    const Header expected;
    if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
    if (bytes.size() < sizeof header || header.magic != expected.magic ||
        header.bytes != bytes.size() - sizeof header)
        return Error{ErrorKind::failed, path, "is no tile of an export: remove it"};
    KeptTile kept{header.has_content != 0, header.triangles, header.error_m, header.box, {}};
    kept.glb.assign(bytes.begin() + sizeof header, bytes.end());
    return std::optional<KeptTile>(std::move(kept));
}

Result<void> KeptTiles::write(const TileIndex& tile, const KeptTile& kept) const {
    Header header;
    header.has_content = kept.has_content ? 1 : 0;
    header.triangles = kept.triangles;
    header.bytes = kept.glb.size();
    header.error_m = kept.error_m;
    header.box = kept.box;
    std::vector<std::uint8_t> bytes(sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
    bytes.insert(bytes.end(), kept.glb.begin(), kept.glb.end());
    return write_whole(path_of(tile), bytes);
}

void KeptTiles::remove() const {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder_, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name == key_name || name.find(tile_ending) != std::string::npos)
            fs::remove(entry->path(), ignored);
    }
    fs::remove(folder_, ignored);
}

}  // namespace oro
