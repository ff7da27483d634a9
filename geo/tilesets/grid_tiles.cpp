#include "geo/tilesets/grid_tiles.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "geo/files/plain_file.h"
#include "geo/tilesets/each_tile.h"
#include "geo/tilesets/tile_boxes.h"

namespace oro {
namespace fs = std::filesystem;

std::string GridTiles::tile_name(const TileIndex& tile) const {
    return maker_.grid().folder() + std::to_string(tile.level) + "/" + std::to_string(tile.row) + "/" +
           std::to_string(tile.column) + ".glb";
}

std::vector<TileIndex> GridTiles::below(const TileIndex& tile) const {
    std::vector<TileIndex> tiles;
    if (tile.level == 0) return tiles;
    for (int i = 0; i < 4; ++i) {
        const TileIndex one{2 * tile.row + i / 2, 2 * tile.column + i % 2, tile.level - 1};
        if (one.row < layout_.rows(one.level) && one.column < layout_.columns(one.level) && at(one).box)
            tiles.push_back(one);
    }
    return tiles;
}

Result<void> GridTiles::make_folders(int level) const {
    std::error_code failed;
    for (int row = 0; row < layout_.rows(level); ++row) {
        const std::string path =
            folder_ + "/" + maker_.grid().folder() + std::to_string(level) + "/" + std::to_string(row);
        if (fs::create_directories(path, failed); failed)
            return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    }
    return {};
}

// Those without a tile; of folders that hold something rmdir does nothing.
void GridTiles::remove_empty_folders(int level) const {
    std::error_code ignored;
    const std::string of_level = folder_ + "/" + maker_.grid().folder() + std::to_string(level);
    for (int row = 0; row < layout_.rows(level); ++row)
        fs::remove(of_level + "/" + std::to_string(row), ignored);
    fs::remove(of_level, ignored);
}

Result<void> GridTiles::write_tile(const TileIndex& tile, WrittenTile& written) const {
    ORO_TRY(const KeptTile one, maker_.tile(tile));
    if (!one.has_content) return {};
    ORO_CHECK(write_plain_file(folder_ + "/" + tile_name(tile), one.glb));
    written = {true, one.triangles, one.glb.size(), one.error_m, one.box};
    return {};
}

void GridTiles::join_boxes(int level) {
    for (std::size_t number = 0; number < layout_.count(level); ++number) {
        std::optional<TileBox>& box = written_.back()[number].box;
        for (const TileIndex& one : below(layout_.tile(number, level)))
            box = box ? joined(*box, *at(one).box) : *at(one).box;
    }
}

Result<void> GridTiles::write(const TilesetProgress& progress) {
    const auto all = static_cast<double>(layout_.all());
    double done = 0.0;
    for (int level = 0; level < layout_.levels(); ++level) {
        ORO_CHECK(make_folders(level));
        std::vector<WrittenTile>& written = written_.emplace_back(layout_.count(level));
        maker_.begin_level(level);
        ORO_CHECK(each_tile(
            written.size(), request_.threads,
            [&](std::size_t number) { return write_tile(layout_.tile(number, level), written[number]); },
            [&](std::size_t now) {
                done += static_cast<double>(now);
                if (progress) progress(done / all);
            }));
        join_boxes(level);
        remove_empty_folders(level);
    }
    return {};
}

nlohmann::ordered_json GridTiles::tile_json(const TileIndex& tile) const {
    nlohmann::ordered_json json;
    json["boundingVolume"]["region"] = region_json_of(*at(tile).box);
    json["geometricError"] = at(tile).error_m;
    if (tile.level == layout_.levels() - 1) json["refine"] = "REPLACE";
    json["content"]["uri"] = tile_name(tile);
    auto children = nlohmann::ordered_json::array();
    for (const TileIndex& one : below(tile)) children.push_back(tile_json(one));
    if (!children.empty()) json["children"] = std::move(children);
    return json;
}

TilesetLevel GridTiles::summed_up(int level) const {
    TilesetLevel sum;
    sum.level = level;
    for (std::size_t number = 0; number < layout_.count(level); ++number) {
        const TileIndex tile = layout_.tile(number, level);
        const WrittenTile& one = at(tile);
        if (!one.has_content) continue;
        ++sum.tiles;
        sum.triangles += one.triangles;
        sum.bytes += one.bytes;
        sum.largest_error_m = std::max(sum.largest_error_m, one.error_m);
    }
    return sum;
}

std::vector<TilesetLevel> GridTiles::levels() const {
    std::vector<TilesetLevel> levels;
    for (int level = root().level; level >= 0; --level) levels.push_back(summed_up(level));
    return levels;
}

Result<std::uint64_t> GridTiles::keep_part(const TilesetProgress& progress) {
    std::uint64_t own = 0;
    double done = 0.0;
    for (int level = 0; level < layout_.levels(); ++level) {
        maker_.begin_level(level);
        for (std::size_t number = 0; number < layout_.count(level); ++number)
            own += maker_.is_own(number) ? 1 : 0;
        ORO_CHECK(each_tile(
            layout_.count(level), request_.threads,
            [&](std::size_t number) -> Result<void> {
                if (!maker_.is_own(number)) return {};
                ORO_TRY(const KeptTile one, maker_.tile(layout_.tile(number, level)));
                return {};
            },
            [&](std::size_t now) {
                done += static_cast<double>(now);
                if (progress) progress(done / static_cast<double>(layout_.all()));
            }));
    }
    return own;
}

}  // namespace oro
