// What is between the grids of a tileset: pieces of ground and upright steps, at full resolution in tiles of
// their own. Within tilesets.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/seam_mesh.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {

// Its tiles have no levels: they are drawn whatever is drawn of the grids.
class SeamTiles {
  public:
    // Both stay where they are. Divides what is between the grids; the same way each time.
    SeamTiles(const TilesetGround& ground, const TilesetRequest& request);

    [[nodiscard]] std::size_t count() const { return tiles_.size(); }
    [[nodiscard]] bool is_own(std::size_t number) const {
        return number % static_cast<std::size_t>(request_.parts) == static_cast<std::size_t>(request_.part);
    }
    [[nodiscard]] bool all_kept() const;
    // What all of it is off: the sag of the cut grids' own triangles, half a step of heights, and rounding.
    [[nodiscard]] EdgeBound bound() const;
    // What the grids have beside it, on any level; before tiles are made.
    void lay_beside(const EdgeBound& grids) { grids_ = grids; }
    // Makes the tile, or takes the one that is kept. From several threads. Errors: those of facts; of files
    // that are kept.
    [[nodiscard]] Result<KeptTile> tile(std::size_t number) const;
    // Writes FOLDER/between/NUMBER.glb of each. Errors (failed): what cannot be written.
    Result<void> write(const std::string& folder);

    // After write().
    [[nodiscard]] std::optional<TileBox> box() const;
    [[nodiscard]] TilesetLevel summed_up() const;
    // A tile of tileset.json each.
    [[nodiscard]] std::vector<nlohmann::ordered_json> tiles_json() const;

  private:
    // Pieces and skirts of one TilesetBetween, by their numbers.
    struct Tile {
        std::size_t between{};
        std::vector<std::uint32_t> pieces, skirts;
    };
    void lay_lattice();
    void divide(Tile tile);
    [[nodiscard]] double error_m(std::size_t between) const;
    [[nodiscard]] EdgeBound bound_of(std::size_t between) const;
    [[nodiscard]] Result<KeptTile> made(std::size_t number) const;

    const TilesetGround& ground_;
    const TilesetRequest& request_;
    std::optional<KeptTiles> kept_;
    std::vector<Tile> tiles_;
    SeamLattice lattice_;  // its step is a sixteenth of the finest grid's error
    EdgeBound grids_;
    std::vector<KeptTile> written_;  // without their bytes
    std::vector<std::uint64_t> bytes_;
};

}  // namespace oro
