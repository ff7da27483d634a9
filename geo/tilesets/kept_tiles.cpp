#include "geo/tilesets/kept_tiles.h"

#include <array>
#include <cstring>
#include <type_traits>

namespace oro {
namespace {

// What a file begins with, as it lies in memory; the bytes of the glTF follow.
struct Header {
    std::array<char, 8> magic{'O', 'R', 'O', 'T', 'I', 'L', 'E', '1'};
    std::uint64_t has_content{}, triangles{}, bytes{};
    double error_m{};
    TileBox box;
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 11 * sizeof(double));

std::string name_of(const TileIndex& tile) {
    return std::to_string(tile.level) + "-" + std::to_string(tile.row) + "-" + std::to_string(tile.column);
}

}  // namespace

Result<KeptTiles> KeptTiles::open(const std::string& folder, const std::string& key) {
    ORO_TRY(KeptParts parts, KeptParts::open(folder, key));
    return KeptTiles(std::move(parts));
}

bool KeptTiles::has(const TileIndex& tile) const {
    return parts_.has(name_of(tile));
}

Result<std::optional<KeptTile>> KeptTiles::read(const TileIndex& tile) const {
    ORO_TRY(const auto read, parts_.read(name_of(tile)));
    if (!read) return std::optional<KeptTile>();
    const std::vector<std::uint8_t>& bytes = *read;
    Header header;
    const Header expected;
    if (bytes.size() >= sizeof header) std::memcpy(&header, bytes.data(), sizeof header);
    if (bytes.size() < sizeof header || header.magic != expected.magic ||
        header.bytes != bytes.size() - sizeof header)
        return Error{ErrorKind::failed, parts_.path_of(name_of(tile)), "is no tile of an export: remove it"};
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
    return parts_.write(name_of(tile), bytes);
}

}  // namespace oro
