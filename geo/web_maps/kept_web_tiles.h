// The tiles of a web map or globe that are done, in a folder beside it: what an export that was stopped goes
// on with, and what several machines share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/files/kept_parts.h"
#include "geo/web_maps/quantized_mesh.h"

namespace oro {

// A tile's file, and what is told of it.
struct KeptWebTile {
    bool has_ground{};      // without: `bytes` is empty
    std::uint64_t holes{};  // pixels or corners without ground
    HeightSteps steps;      // of quantized meshes
    std::vector<std::uint8_t> bytes;
};

// A file a tile, ZOOM-X-Y.tile (KeptParts). May be used from several threads, and by several processes at
// once.
class KeptWebTiles {
  public:
    // Errors: those of KeptParts::open().
    static Result<KeptWebTiles> open(const std::string& folder, const std::string& key);

    // Nothing where the tile is not there. Errors (failed): a file that is none of these.
    [[nodiscard]] Result<std::optional<KeptWebTile>> read(int zoom, std::int64_t x, std::int64_t y) const;
    [[nodiscard]] Result<void> write(int zoom, std::int64_t x, std::int64_t y, const KeptWebTile& kept) const;
    void remove() const { parts_.remove(); }

  private:
    explicit KeptWebTiles(KeptParts parts) : parts_(std::move(parts)) {}

    KeptParts parts_;
};

// Of tiles that several machines make together, part 0 .. parts - 1 of one of them: every so many-th tile.
struct WebTilesPart {
    const KeptWebTiles* kept{};  // where tiles that are done are kept, and taken from; null: nowhere
    std::size_t part{}, parts{1};
    [[nodiscard]] bool holds(std::size_t number) const { return number % parts == part; }
};

}  // namespace oro
