#include "geo/tilesets/ground_tileset.h"

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "geo/files/plain_file.h"
#include "geo/tilesets/each_tile.h"
#include "geo/tilesets/grid_tiles.h"
#include "geo/tilesets/mesh_tiles.h"
#include "geo/tilesets/seam_tiles.h"
#include "geo/tilesets/source_table.h"
#include "geo/tilesets/tile_boxes.h"
#include "geo/tilesets/tile_maker.h"

namespace oro {
namespace {
using Json = nlohmann::ordered_json;

// What makes the tiles of all grids, and those between them.
class TilesetMaker {
  public:
    TilesetMaker(const TilesetGround& ground, const TilesetRequest& request) : between_(ground, request) {
        for (const TilesetGrid& grid : ground.grids) grids_.emplace_back(grid, request);
    }
    // Gets the grounds, unless all tiles of the part are kept. Walls depend on all of them.
    Result<void> begin();
    [[nodiscard]] std::deque<TileMaker>& grids() { return grids_; }
    [[nodiscard]] SeamTiles& between() { return between_; }

  private:
    std::deque<TileMaker> grids_;
    SeamTiles between_;
};

Result<void> TilesetMaker::begin() {
    if (between_.all_kept() && std::ranges::all_of(grids_, &TileMaker::all_kept)) return {};
    std::vector<EdgeBound> bounds;
    EdgeBound all;
    for (TileMaker& grid : grids_) {
        ORO_CHECK(grid.begin());
        bounds.push_back(grid.bound());
        all.widen(bounds.back());
    }
    between_.lay_beside(all);
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        EdgeBound others = between_.bound();
        for (std::size_t j = 0; j < bounds.size(); ++j)
            if (j != i) others.widen(bounds[j]);
        grids_[i].lay_beside(others);
    }
    return {};
}

// How much is done of all grids, by their tiles.
class SharedProgress {
  public:
    SharedProgress(std::deque<TileMaker>& grids, const TilesetProgress& progress) : progress_(progress) {
        for (const TileMaker& grid : grids) all_ += static_cast<double>(grid.layout().all());
    }
    // Of the next grid.
    [[nodiscard]] TilesetProgress of(const TileMaker& grid) {
        const double first = done_, share = static_cast<double>(grid.layout().all());
        done_ += share;
        return [this, first, share](double of_grid) {
            if (progress_) progress_((first + of_grid * share) / all_);
        };
    }

  private:
    const TilesetProgress& progress_;
    double done_{}, all_{};
};

// Writes the tiles, and then the file that tells of them.
class TilesetWriter {
  public:
    TilesetWriter(const std::string& folder, const TilesetGround& ground, TilesetMaker& maker,
                  const TilesetRequest& request)
        : folder_(folder), ground_(ground), maker_(maker), request_(request) {}

    Result<void> write_tiles(const TilesetProgress& progress);
    Result<void> write_meshes();
    Result<TilesetWritten> write_json();

  private:
    [[nodiscard]] Json mesh_tile_json(const MeshTile& tile) const;
    [[nodiscard]] Json root_json(const TilesetWritten& written) const;
    [[nodiscard]] Json metadata_json() const;
    [[nodiscard]] std::optional<TileBox> whole_box() const;
    void sum_up_meshes(TilesetWritten& written) const;
    void sum_up(TilesetWritten& written) const;

    const std::string& folder_;
    const TilesetGround& ground_;
    TilesetMaker& maker_;
    const TilesetRequest& request_;
    std::deque<GridTiles> grids_;
    std::vector<MeshTile> mesh_tiles_;  // the first is the root of the others
};

Result<void> TilesetWriter::write_tiles(const TilesetProgress& progress) {
    SharedProgress shared(maker_.grids(), progress);
    for (TileMaker& grid : maker_.grids()) {
        grids_.emplace_back(folder_, grid, request_);
        ORO_CHECK(grids_.back().write(shared.of(grid)));
    }
    return maker_.between().write(folder_);
}

Json TilesetWriter::mesh_tile_json(const MeshTile& tile) const {
    Json json = Json::object();
    json["boundingVolume"]["region"] = region_json_of(tile.box);
    json["geometricError"] = tile.error_m;
    if (tile.level && !tile.children.empty()) json["refine"] = "REPLACE";
    if (!tile.name.empty()) json["content"]["uri"] = tile.name;
    Json children = Json::array();
    for (const std::size_t child : tile.children) children.push_back(mesh_tile_json(mesh_tiles_[child]));
    if (!children.empty()) json["children"] = std::move(children);
    return json;
}

// The ground of one grid alone, or all grids, what is between them, and the meshes, which add to each other.
Json TilesetWriter::root_json(const TilesetWritten& written) const {
    if (mesh_tiles_.empty() && grids_.size() == 1) return grids_.front().root_json();
    Json json = Json::object();
    json["boundingVolume"]["region"] = region_json_of(written.box);
    json["geometricError"] = written.geometric_error_m;
    json["refine"] = "ADD";
    json["children"] = Json::array();
    for (const GridTiles& grid : grids_)
        if (grid.box()) json["children"].push_back(grid.root_json());
    for (Json& tile : maker_.between().tiles_json()) json["children"].push_back(std::move(tile));
    if (mesh_tiles_.empty()) return json;
    Json meshes = mesh_tile_json(mesh_tiles_.front());
    meshes["refine"] = "ADD";
    json["children"].push_back(std::move(meshes));
    return json;
}

Result<void> TilesetWriter::write_meshes() {
    if (!request_.meshes) return {};
    MeshTilesRequest asked;
    asked.look = request_.look;
    asked.palette = request_.meshes->palette;
    asked.normals = request_.normals;
    asked.most_triangles = request_.meshes->most_triangles;
    asked.whole_triangles = request_.meshes->whole_triangles;
    asked.threads = request_.threads;
    const UndulationField without;
    ORO_TRY(mesh_tiles_,
            write_mesh_tiles(folder_, *request_.meshes->meshes,
                             request_.undulation == nullptr ? without : *request_.undulation, asked));
    return {};
}

// Each of them a string of one class, and the sources one by one: their names, whose they are, and how
// accurate. Source: OGC 22-025r4, 3D Metadata Specification.
Json TilesetWriter::metadata_json() const {
    Json properties = Json::object(), values = Json::object();
    for (const auto& [name, text] : request_.metadata) {
        properties[name]["type"] = "STRING";
        values[name] = text;
    }
    Json names = Json::array(), accuracies = Json::array();
    for (const TilesetGrid& grid : ground_.grids)
        for (const GroundSource& source : grid.sources) {
            names.push_back(source.name);
            accuracies.push_back(source.vertical_le90_m);
        }
    if (!names.empty()) {
        properties["sources"]["type"] = "STRING";
        properties["sourcesVerticalLe90"] = source_class_json()["properties"]["vertical_le90_m"];
        for (const char* const name : {"sources", "sourcesVerticalLe90"}) properties[name]["array"] = true;
        properties["sourcesVerticalLe90"].erase("noData");
        values["sources"] = std::move(names);
        values["sourcesVerticalLe90"] = std::move(accuracies);
    }
    Json json = Json::object();
    json["schema"]["id"] = "orograph_ground";
    json["schema"]["classes"]["ground"]["properties"] = std::move(properties);
    json["metadata"]["class"] = "ground";
    json["metadata"]["properties"] = std::move(values);
    return json;
}

std::optional<TileBox> TilesetWriter::whole_box() const {
    std::optional<TileBox> whole;
    const auto add = [&](const std::optional<TileBox>& box) {
        if (box) whole = whole ? joined(*whole, *box) : *box;
    };
    for (const GridTiles& grid : grids_) add(grid.box());
    if (!whole) return whole;
    add(maker_.between().box());
    if (!mesh_tiles_.empty()) add(mesh_tiles_.front().box);
    return whole;
}

void TilesetWriter::sum_up_meshes(TilesetWritten& written) const {
    int levels = 0;
    for (const MeshTile& tile : mesh_tiles_)
        if (tile.level) levels = std::max(levels, *tile.level + 1);
    for (int level = levels - 1; level >= 0; --level) written.mesh_levels.emplace_back().level = level;
    for (const MeshTile& tile : mesh_tiles_) {
        const auto add_to = [&](TilesetLevel& sum) {
            sum.tiles += tile.name.empty() ? 0 : 1;
            sum.triangles += tile.triangles;
            sum.bytes += tile.bytes;
        };
        add_to(written.meshes);
        if (!tile.level) {
            // Where things have levels the root draws nothing, and so says nothing of what is missing.
            if (levels > 0 && &tile == &mesh_tiles_.front()) continue;
            written.meshes.largest_error_m = std::max(written.meshes.largest_error_m, tile.error_m);
            continue;
        }
        TilesetLevel& of_level = written.mesh_levels[static_cast<std::size_t>(levels - 1 - *tile.level)];
        add_to(of_level);
        of_level.largest_error_m = std::max(of_level.largest_error_m, tile.error_m);
    }
}

void TilesetWriter::sum_up(TilesetWritten& written) const {
    for (const GridTiles& grid : grids_) written.grids.push_back(grid.levels());
    written.between = maker_.between().summed_up();
    sum_up_meshes(written);
    written.geometric_error_m = std::max(size_m(written.box), written.between.largest_error_m);
    if (!mesh_tiles_.empty())
        written.geometric_error_m = std::max(written.geometric_error_m, mesh_tiles_.front().error_m);
    for (const std::vector<TilesetLevel>& levels : written.grids)
        for (const TilesetLevel& level : levels)
            written.geometric_error_m = std::max(written.geometric_error_m, level.largest_error_m);
    written.root_error_m = grids_.front().root_error_m();
}

Result<TilesetWritten> TilesetWriter::write_json() {
    const std::optional<TileBox> box = whole_box();
    if (!box) return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    TilesetWritten written;
    written.box = *box;
    sum_up(written);
    Json json = Json::object();
    json["asset"]["version"] = "1.1";
    json["asset"]["generator"] = request_.look.generator;
    if (!request_.metadata.empty()) json.update(metadata_json());
    json["geometricError"] = written.geometric_error_m;
    json["root"] = root_json(written);
    const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    ORO_CHECK(write_plain_file(folder_ + "/tileset.json",
                               {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    return written;
}

}  // namespace

double usual_finest_error_m(const PostGrid& grid) {
    constexpr double share = 0.2;
    return share * largest_spacing_m(grid);
}

Result<TilesetWritten> write_tileset(const std::string& folder, const TilesetGround& ground,
                                     const TilesetRequest& request, const TilesetProgress& progress) {
    TilesetMaker maker(ground, request);
    ORO_CHECK(maker.begin());
    TilesetWriter writer(folder, ground, maker, request);
    ORO_CHECK(writer.write_tiles(progress));
    ORO_CHECK(writer.write_meshes());
    return writer.write_json();
}

Result<std::uint64_t> make_tiles(const TilesetGround& ground, const TilesetRequest& request,
                                 const TilesetProgress& progress) {
    TilesetMaker maker(ground, request);
    ORO_CHECK(maker.begin());
    const std::string nowhere;
    SharedProgress shared(maker.grids(), progress);
    std::uint64_t own = 0;
    for (TileMaker& grid : maker.grids()) {
        ORO_TRY(const std::uint64_t of_grid, GridTiles(nowhere, grid, request).keep_part(shared.of(grid)));
        own += of_grid;
    }
    const SeamTiles& between = maker.between();
    for (std::size_t number = 0; number < between.count(); ++number) {
        if (!between.is_own(number)) continue;
        ++own;
        ORO_TRY(const KeptTile one, between.tile(number));
    }
    return own;
}

}  // namespace oro
