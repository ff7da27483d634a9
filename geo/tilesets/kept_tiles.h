// The tiles of a tileset that are done, in a folder beside it: what an export that was stopped goes on with,
// and what several machines share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "geo/files/kept_parts.h"
#include "geo/tilesets/ground_mesh.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// A tile and what the tileset says of it.
struct KeptTile {
    bool has_content{};  // without: nothing is drawn there, and the rest means nothing
    std::uint64_t triangles{};
    double error_m{};
    TileBox box;  // of the tile alone
    std::vector<std::uint8_t> glb;
};

// A file a tile, LEVEL-ROW-COLUMN.tile (KeptParts). May be used from several threads, and by several
// processes at once.
class KeptTiles {
  public:
    // Errors: those of KeptParts::open().
    static Result<KeptTiles> open(const std::string& folder, const std::string& key);

    // Those of one grid among several, in the same folder: NAME-LEVEL-ROW-COLUMN.tile. "": of one alone.
    [[nodiscard]] KeptTiles of(const std::string& name) const;

    // Nothing where the tile is not there. Errors (failed): a file that is none of these.
    [[nodiscard]] Result<std::optional<KeptTile>> read(const TileIndex& tile) const;
    [[nodiscard]] bool has(const TileIndex& tile) const;
    [[nodiscard]] Result<void> write(const TileIndex& tile, const KeptTile& kept) const;
    void remove() const { parts_.remove(); }

  private:
    explicit KeptTiles(KeptParts parts) : parts_(std::move(parts)) {}

    [[nodiscard]] std::string name_of(const TileIndex& tile) const;

    KeptParts parts_;
    std::string before_;  // a tile's own name
};

// The tile that is kept, or what make() gives as a Result<KeptTile>, which is kept then. kept: null for
// nowhere. Errors: those of make() and of `kept`.
template <class Make>
Result<KeptTile> kept_or_made(const KeptTiles* kept, const TileIndex& tile, const Make& make) {
    if (kept == nullptr) return make();
    ORO_TRY(std::optional<KeptTile> known, kept->read(tile));
    if (known) return std::move(*known);
    ORO_TRY(KeptTile one, make());
    ORO_CHECK(kept->write(tile, one));
    return one;
}

}  // namespace oro
