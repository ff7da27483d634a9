// The files of a grid's tiles, and what the tileset says of them. Within tilesets.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/tile_maker.h"

namespace oro {

class GridTiles {
  public:
    // All stay where they are.
    GridTiles(const std::string& folder, TileMaker& maker, const TilesetRequest& request)
        : folder_(folder), maker_(maker), request_(request), layout_(maker.layout()) {}

    // The finest first. progress: a share of all this grid's tiles.
    Result<void> write(const TilesetProgress& progress);
    // Makes those of the request's part alone, and keeps them: how many there are now.
    Result<std::uint64_t> keep_part(const TilesetProgress& progress);

    // After write(): nothing where the grid has no triangle.
    [[nodiscard]] const std::optional<TileBox>& box() const { return at(root()).box; }
    [[nodiscard]] double root_error_m() const { return at(root()).error_m; }
    [[nodiscard]] nlohmann::ordered_json root_json() const { return tile_json(root()); }
    // The coarsest first.
    [[nodiscard]] std::vector<TilesetLevel> levels() const;

  private:
    // What is known of a tile when its file is written.
    struct WrittenTile {
        bool has_content{};
        std::uint64_t triangles{}, bytes{};
        double error_m{};
        std::optional<TileBox> box;  // of all that is below it, too
    };
    [[nodiscard]] std::string tile_name(const TileIndex& tile) const;
    Result<void> make_folders(int level) const;
    void remove_empty_folders(int level) const;
    Result<void> write_tile(const TileIndex& tile, WrittenTile& written) const;
    void join_boxes(int level);
    [[nodiscard]] TileIndex root() const { return {0, 0, layout_.levels() - 1}; }
    [[nodiscard]] const WrittenTile& at(const TileIndex& tile) const {
        return written_[static_cast<std::size_t>(tile.level)][layout_.number(tile)];
    }
    [[nodiscard]] std::vector<TileIndex> below(const TileIndex& tile) const;
    [[nodiscard]] nlohmann::ordered_json tile_json(const TileIndex& tile) const;
    [[nodiscard]] TilesetLevel summed_up(int level) const;

    const std::string& folder_;
    TileMaker& maker_;
    const TilesetRequest& request_;
    const TilesetLayout& layout_;
    std::vector<std::vector<WrittenTile>> written_;  // by level
};

}  // namespace oro
