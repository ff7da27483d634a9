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

    // Nothing where the tile is not there. Errors (failed): a file that is none of these.
    [[nodiscard]] Result<std::optional<KeptTile>> read(const TileIndex& tile) const;
    [[nodiscard]] bool has(const TileIndex& tile) const;
    [[nodiscard]] Result<void> write(const TileIndex& tile, const KeptTile& kept) const;
    void remove() const { parts_.remove(); }

  private:
    explicit KeptTiles(KeptParts parts) : parts_(std::move(parts)) {}

    KeptParts parts_;
};

}  // namespace oro
