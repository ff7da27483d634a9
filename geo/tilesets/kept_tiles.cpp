#include "geo/tilesets/kept_tiles.h"

#include "geo/files/framed_part.h"

namespace oro {
namespace {

constexpr FrameName frame{'O', 'R', 'O', 'T', 'I', 'L', 'E', '2'};

struct FactsOfTile {
    std::uint64_t has_content{}, triangles{};
    double error_m{};
    TileBox box;
};
static_assert(sizeof(FactsOfTile) == 9 * sizeof(double));

}  // namespace

Result<KeptTiles> KeptTiles::open(const std::string& folder, const std::string& key) {
    ORO_TRY(KeptParts parts, KeptParts::open(folder, key));
    return KeptTiles(std::move(parts));
}

KeptTiles KeptTiles::of(const std::string& name) const {
    KeptTiles some = *this;
    if (!name.empty()) some.before_ = name + "-";
    return some;
}

std::string KeptTiles::name_of(const TileIndex& tile) const {
    return before_ + std::to_string(tile.level) + "-" + std::to_string(tile.row) + "-" +
           std::to_string(tile.column);
}

bool KeptTiles::has(const TileIndex& tile) const {
    return parts_.has(name_of(tile));
}

Result<std::optional<KeptTile>> KeptTiles::read(const TileIndex& tile) const {
    ORO_TRY(auto read, read_framed<FactsOfTile>(parts_, name_of(tile), frame));
    if (!read) return std::optional<KeptTile>();
    const FactsOfTile& facts = read->facts;
    return std::optional<KeptTile>(
        {facts.has_content != 0, facts.triangles, facts.error_m, facts.box, std::move(read->bytes)});
}

Result<void> KeptTiles::write(const TileIndex& tile, const KeptTile& kept) const {
    const FactsOfTile facts{kept.has_content ? 1U : 0U, kept.triangles, kept.error_m, kept.box};
    return write_framed(parts_, name_of(tile), frame, facts, kept.glb);
}

}  // namespace oro
