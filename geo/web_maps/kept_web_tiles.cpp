#include "geo/web_maps/kept_web_tiles.h"

#include "geo/files/framed_part.h"

namespace oro {
namespace {

constexpr FrameName web_frame{'O', 'R', 'O', 'W', 'E', 'B', '0', '2'};

struct FactsOfWebTile {
    std::uint64_t has_ground{}, holes{};
    HeightSteps steps;
};
static_assert(sizeof(FactsOfWebTile) == 24);

std::string name_of_web_tile(int zoom, std::int64_t x, std::int64_t y) {
    return std::to_string(zoom) + "-" + std::to_string(x) + "-" + std::to_string(y);
}

}  // namespace

Result<KeptWebTiles> KeptWebTiles::open(const std::string& folder, const std::string& key) {
    ORO_TRY(KeptParts parts, KeptParts::open(folder, key));
    return KeptWebTiles(std::move(parts));
}

Result<std::optional<KeptWebTile>> KeptWebTiles::read(int zoom, std::int64_t x, std::int64_t y) const {
    ORO_TRY(auto read, read_framed<FactsOfWebTile>(parts_, name_of_web_tile(zoom, x, y), web_frame));
    if (!read) return std::optional<KeptWebTile>();
    const FactsOfWebTile& facts = read->facts;
    return std::optional<KeptWebTile>(
        {facts.has_ground != 0, facts.holes, facts.steps, std::move(read->bytes)});
}

Result<void> KeptWebTiles::write(int zoom, std::int64_t x, std::int64_t y, const KeptWebTile& kept) const {
    const FactsOfWebTile facts{kept.has_ground ? 1U : 0U, kept.holes, kept.steps};
    return write_framed(parts_, name_of_web_tile(zoom, x, y), web_frame, facts, kept.bytes);
}

}  // namespace oro
