#include "geo/web_maps/kept_web_tiles.h"

#include <array>
#include <cstring>
#include <type_traits>

namespace oro {
namespace {

// What a file begins with, as it lies in memory; the tile's own bytes follow.
struct WebTileHeader {
    std::array<char, 8> magic{'O', 'R', 'O', 'W', 'E', 'B', '0', '1'};
    std::uint64_t has_ground{}, holes{}, bytes{};
    HeightSteps steps;
};
static_assert(std::is_trivially_copyable_v<WebTileHeader> && sizeof(WebTileHeader) == 40);

std::string name_of_web_tile(int zoom, std::int64_t x, std::int64_t y) {
    return std::to_string(zoom) + "-" + std::to_string(x) + "-" + std::to_string(y);
}

}  // namespace

Result<KeptWebTiles> KeptWebTiles::open(const std::string& folder, const std::string& key) {
    ORO_TRY(KeptParts parts, KeptParts::open(folder, key));
    return KeptWebTiles(std::move(parts));
}

Result<std::optional<KeptWebTile>> KeptWebTiles::read(int zoom, std::int64_t x, std::int64_t y) const {
    const std::string name = name_of_web_tile(zoom, x, y);
    ORO_TRY(const auto read, parts_.read(name));
    if (!read) return std::optional<KeptWebTile>();
    WebTileHeader header;
    const WebTileHeader expected;
    if (read->size() >= sizeof header) std::memcpy(&header, read->data(), sizeof header);
    if (read->size() < sizeof header || header.magic != expected.magic ||
        header.bytes != read->size() - sizeof header)
        return Error{ErrorKind::failed, parts_.path_of(name), "is no tile of an export: remove it"};
    KeptWebTile kept{header.has_ground != 0, header.holes, header.steps, {}};
    kept.bytes.assign(read->begin() + sizeof header, read->end());
    return std::optional<KeptWebTile>(std::move(kept));
}

Result<void> KeptWebTiles::write(int zoom, std::int64_t x, std::int64_t y, const KeptWebTile& kept) const {
    WebTileHeader header;
    header.has_ground = kept.has_ground ? 1 : 0;
    header.holes = kept.holes;
    header.bytes = kept.bytes.size();
    header.steps = kept.steps;
    std::vector<std::uint8_t> bytes(sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
    bytes.insert(bytes.end(), kept.bytes.begin(), kept.bytes.end());
    return parts_.write(name_of_web_tile(zoom, x, y), bytes);
}

}  // namespace oro
