#include "geo/tilesets/ground_tileset.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <system_error>

#include "core/base/parallel.h"
#include "geo/files/plain_file.h"
#include "geo/tilesets/ground_mesh.h"
#include "geo/tilesets/level_cut.h"
#include "geo/tilesets/mesh_tiles.h"
#include "geo/tilesets/post_place.h"
#include "geo/tilesets/source_table.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// What is known of a tile when its file is written.
struct WrittenTile {
    bool has_content{};
    std::uint64_t triangles{}, bytes{};
    double error_m{};
    std::optional<TileBox> box;  // of all that is below it, too
};

// One that holds both. Longitudes stay in the first one's whole turn.
TileBox joined(const TileBox& a, const TileBox& b) {
    constexpr double turn_deg = 360.0;
    const double shift_deg =
        turn_deg * std::round(0.5 * (a.west_deg + a.east_deg - b.west_deg - b.east_deg) / turn_deg);
    TileBox box{std::min(a.west_deg, b.west_deg + shift_deg), std::min(a.south_deg, b.south_deg),
                std::max(a.east_deg, b.east_deg + shift_deg), std::max(a.north_deg, b.north_deg),
                std::min(a.lowest_h_m, b.lowest_h_m),         std::max(a.highest_h_m, b.highest_h_m)};
    if (box.east_deg - box.west_deg >= turn_deg) box.west_deg = -180.0, box.east_deg = 180.0;
    return box;
}

// How far from one corner of a box to the other it is, at most.
double size_m(const TileBox& box) {
    const double tall = radians_from_deg(box.north_deg - box.south_deg).rad;
    const double wide = radians_from_deg(box.east_deg - box.west_deg).rad;
    return std::hypot((wgs84_a_m + std::max(0.0, box.highest_h_m)) * std::min(2.0, std::hypot(tall, wide)),
                      box.highest_h_m - box.lowest_h_m);
}

std::string tile_name(const TileIndex& page) {
    return std::to_string(page.level) + "/" + std::to_string(page.row) + "/" + std::to_string(page.column) +
           ".glb";
}

// What a level aims at.
struct LevelAim {
    double cut_m{};   // error of the cut of clusters
    double step_m{};  // that positions are rounded to
};

// Errors grow from level to level by this while a tile's sides are doubled: so tiles of all levels have some
// as many triangles.
constexpr double error_growth = 3.0;
// Of positions with 16 bits, and with those of float, a sign among them.
constexpr double steps_of_short = 65000.0, steps_of_float = 0x1.0p23;

double largest_spacing_m(const PostGrid& grid) {
    return wgs84_a_m * std::max(grid.row_step_rad(), grid.column_step_rad());
}

// The step is a sixteenth of the error, or somewhat more where positions then have 16 bits.
LevelAim aim_of(const ClusteredGround& ground, const TilesetLayout& layout, int level,
                double finest_error_m) {
    constexpr double usual_share = 1.0 / 16.0, most_share = 1.0 / 8.0;
    constexpr double finest_m = 0x1.0p-11, coarsest_of_posts_m = 0x1.0p-4, share_of_posts = 0x1.0p-10;
    const PostGrid& grid = ground.grid();
    const double spacing_m = largest_spacing_m(grid);
    const double error_m =
        level == 0 ? finest_error_m
                   : std::max(finest_error_m, usual_finest_error_m(grid)) * std::pow(error_growth, level);
    const TilesetLayout::Lines first = layout.lines({0, 0, level});
    const double size_m =
        std::min(3.0 * wgs84_a_m, spacing_m * std::hypot(first.south - first.north, first.east - first.west));
    LevelAim aim;
    aim.step_m =
        std::max({finest_m, usual_share * error_m, std::min(coarsest_of_posts_m, share_of_posts * spacing_m),
                  size_m / steps_of_float});
    const double short_m = size_m / steps_of_short;
    if (short_m <= most_share * error_m) aim.step_m = std::max(aim.step_m, short_m);
    const double rise_m = ground.highest_h_m() - ground.lowest_h_m() + 2.0 * error_m;
    aim.cut_m = std::max(
        0.0, error_m - TileBounds::added_m(grid, ground.highest_h_m() + error_m, rise_m, aim.step_m));
    return aim;
}

// The tiles of a request, made from the ground or taken from those that are kept.
class TileMaker {
  public:
    TileMaker(const PostGrid& grid, const TilesetRequest& request)
        : request_(request), layout_(grid.rows(), grid.columns(), request.tile_quads) {}

    [[nodiscard]] const TilesetLayout& layout() const { return layout_; }
    // Whether a tile is one of the request's part.
    [[nodiscard]] bool is_own(std::size_t number) const {
        return number % static_cast<std::size_t>(request_.parts) == static_cast<std::size_t>(request_.part);
    }
    // Gets the ground, unless all tiles of the part are kept.
    Result<void> begin(const GroundSourceOfTiles& ground);
    // Before tiles of a level are asked for.
    void begin_level(int level);
    // From several threads.
    [[nodiscard]] Result<KeptTile> tile(const TileIndex& tile) const;

  private:
    [[nodiscard]] bool all_kept() const;
    [[nodiscard]] Result<KeptTile> made(const TileIndex& tile) const;

    const TilesetRequest& request_;
    TilesetLayout layout_;
    std::unique_ptr<ClusteredGround> ground_;
    std::vector<LevelCut> cuts_;
    std::optional<TileBounds> bounds_;
    std::vector<glm::vec3> normals_;  // of the level
};

bool TileMaker::all_kept() const {
    if (request_.kept == nullptr) return false;
    for (int level = 0; level < layout_.levels(); ++level)
        for (std::size_t number = 0; number < layout_.count(level); ++number)
            if (is_own(number) && !request_.kept->has(layout_.tile(number, level))) return false;
    return true;
}

Result<void> TileMaker::begin(const GroundSourceOfTiles& ground) {
    if (all_kept()) return {};
    ORO_TRY(ground_, ground());
    cuts_.resize(static_cast<std::size_t>(layout_.levels()));
    in_parallel(layout_.levels(), request_.threads, [&](int level) {
        const LevelAim aim = aim_of(*ground_, layout_, level, request_.finest_error_m);
        cuts_[static_cast<std::size_t>(level)] = level_cut(*ground_, layout_, level, aim.cut_m, aim.step_m);
    });
    bounds_ = TileBounds::of(*ground_, layout_, cuts_);
    return {};
}

void TileMaker::begin_level(int level) {
    if (ground_ && request_.normals) normals_ = normals_of(*ground_, cuts_[static_cast<std::size_t>(level)]);
}

Result<KeptTile> TileMaker::made(const TileIndex& tile) const {
    KeptTile made;
    if (!bounds_->drawn(tile)) return made;
    const GroundMesh mesh = ground_mesh(*ground_, layout_, cuts_[static_cast<std::size_t>(tile.level)], tile,
                                        bounds_->walls(tile), normals_);
    VertexFacts facts;
    if (request_.facts) {
        ORO_TRY(facts, request_.facts(tile.level, mesh.places));
    }
    made = {true, mesh.ground_triangles, bounds_->error_m(tile), mesh.box,
            glb_bytes(mesh, facts, request_.look)};
    return made;
}

Result<KeptTile> TileMaker::tile(const TileIndex& tile) const {
    if (request_.kept == nullptr) return made(tile);
    ORO_TRY(std::optional<KeptTile> kept, request_.kept->read(tile));
    if (kept) return std::move(*kept);
    ORO_TRY(KeptTile one, made(tile));
    ORO_CHECK(request_.kept->write(tile, one));
    return one;
}

// Calls work(number) for each tile of a level on several threads, in parts, so that progress is report
// between them. Errors: the first that a call has.
template <class Work, class Report>
Result<void> each_tile(std::size_t count, int threads, const Work& work, const Report& report) {
    std::mutex mutex;
    Result<void> fault;
    const std::size_t at_once = std::size_t{16} * static_cast<std::size_t>(threads);
    for (std::size_t first = 0; first < count && fault.ok(); first += at_once) {
        const std::size_t now = std::min(at_once, count - first);
        in_parallel(static_cast<int>(now), threads, [&](int i) {
            const Result<void> one = work(first + static_cast<std::size_t>(i));
            const std::scoped_lock lock(mutex);
            if (!one.ok() && fault.ok()) fault = one.error();
        });
        report(now);
    }
    return fault;
}

// Writes the tiles, the finest first, and then the file that tells of them.
class TilesetWriter {
  public:
    TilesetWriter(const std::string& folder, TileMaker& maker, const TilesetRequest& request)
        : folder_(folder), maker_(maker), request_(request), layout_(maker.layout()) {}

    Result<void> write_tiles(const TilesetProgress& progress);
    Result<void> write_meshes();
    Result<TilesetWritten> write_json();

  private:
    Result<void> make_folders(int level) const;
    Result<void> write_tile(const TileIndex& tile, WrittenTile& written) const;
    void join_boxes(int level);
    [[nodiscard]] const WrittenTile& at(const TileIndex& tile) const {
        return written_[static_cast<std::size_t>(tile.level)][layout_.number(tile)];
    }
    [[nodiscard]] std::vector<TileIndex> below(const TileIndex& tile) const;
    [[nodiscard]] Json tile_json(const TileIndex& tile) const;
    [[nodiscard]] Json mesh_tile_json(const MeshTile& tile) const;
    [[nodiscard]] Json root_json(const TileIndex& root, const TilesetWritten& written) const;
    [[nodiscard]] Json metadata_json() const;
    [[nodiscard]] TilesetLevel summed_up(int level) const;

    const std::string& folder_;
    TileMaker& maker_;
    const TilesetRequest& request_;
    const TilesetLayout& layout_;
    std::vector<std::vector<WrittenTile>> written_;  // by level
    std::vector<MeshTile> mesh_tiles_;               // the first is the root of the others
    double tileset_error_m_{};
};

std::vector<TileIndex> TilesetWriter::below(const TileIndex& tile) const {
    std::vector<TileIndex> tiles;
    if (tile.level == 0) return tiles;
    for (int i = 0; i < 4; ++i) {
        const TileIndex one{2 * tile.row + i / 2, 2 * tile.column + i % 2, tile.level - 1};
        if (one.row < layout_.rows(one.level) && one.column < layout_.columns(one.level) && at(one).box)
            tiles.push_back(one);
    }
    return tiles;
}

Result<void> TilesetWriter::make_folders(int level) const {
    std::error_code failed;
    for (int row = 0; row < layout_.rows(level); ++row) {
        const std::string path = folder_ + "/" + std::to_string(level) + "/" + std::to_string(row);
        if (fs::create_directories(path, failed); failed)
            return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    }
    return {};
}

Result<void> TilesetWriter::write_tile(const TileIndex& tile, WrittenTile& written) const {
    ORO_TRY(const KeptTile one, maker_.tile(tile));
    if (!one.has_content) return {};
    ORO_CHECK(write_plain_file(folder_ + "/" + tile_name(tile), one.glb));
    written = {true, one.triangles, one.glb.size(), one.error_m, one.box};
    return {};
}

void TilesetWriter::join_boxes(int level) {
    for (std::size_t number = 0; number < layout_.count(level); ++number) {
        std::optional<TileBox>& box = written_.back()[number].box;
        for (const TileIndex& one : below(layout_.tile(number, level)))
            box = box ? joined(*box, *at(one).box) : *at(one).box;
    }
}

Result<void> TilesetWriter::write_tiles(const TilesetProgress& progress) {
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
        std::error_code ignored;
        // Those without a tile; of folders that hold something rmdir does nothing.
        for (int row = 0; row < layout_.rows(level); ++row)
            fs::remove(folder_ + "/" + std::to_string(level) + "/" + std::to_string(row), ignored);
        fs::remove(folder_ + "/" + std::to_string(level), ignored);
    }
    return {};
}

Json region_json_of(const TileBox& box) {
    const auto lon_rad = [](double lon_deg) { return radians_from_deg(std::remainder(lon_deg, 360.0)).rad; };
    const bool round = box.east_deg - box.west_deg >= 360.0;
    constexpr double half_turn = std::numbers::pi;
    Json list = Json::array();
    for (const double value : {round ? -half_turn : lon_rad(box.west_deg),
                               radians_from_deg(box.south_deg).rad, round ? half_turn : lon_rad(box.east_deg),
                               radians_from_deg(box.north_deg).rad, box.lowest_h_m, box.highest_h_m})
        list.push_back(value);
    return list;
}

Json TilesetWriter::tile_json(const TileIndex& tile) const {
    Json json = Json::object();
    json["boundingVolume"]["region"] = region_json_of(*at(tile).box);
    json["geometricError"] = at(tile).error_m;
    if (tile.level == layout_.levels() - 1) json["refine"] = "REPLACE";
    json["content"]["uri"] = tile_name(tile);
    Json children = Json::array();
    for (const TileIndex& one : below(tile)) children.push_back(tile_json(one));
    if (!children.empty()) json["children"] = std::move(children);
    return json;
}

Json TilesetWriter::mesh_tile_json(const MeshTile& tile) const {
    Json json = Json::object();
    json["boundingVolume"]["region"] = region_json_of(tile.box);
    json["geometricError"] = tile.error_m;
    if (!tile.name.empty()) json["content"]["uri"] = tile.name;
    Json children = Json::array();
    for (const std::size_t child : tile.children) children.push_back(mesh_tile_json(mesh_tiles_[child]));
    if (!children.empty()) json["children"] = std::move(children);
    return json;
}

// The ground alone, or beside it the meshes, which add to it.
Json TilesetWriter::root_json(const TileIndex& root, const TilesetWritten& written) const {
    if (mesh_tiles_.empty()) return tile_json(root);
    Json json = Json::object();
    json["boundingVolume"]["region"] = region_json_of(written.box);
    json["geometricError"] = written.geometric_error_m;
    json["refine"] = "ADD";
    json["children"] = Json::array();
    json["children"].push_back(tile_json(root));
    Json meshes = mesh_tile_json(mesh_tiles_.front());
    meshes["refine"] = "ADD";
    json["children"].push_back(std::move(meshes));
    return json;
}

Result<void> TilesetWriter::write_meshes() {
    if (!request_.meshes) return {};
    MeshTilesRequest asked;
    asked.look = request_.look;
    asked.look.colour = request_.meshes->colour;
    asked.normals = request_.normals;
    asked.most_triangles = request_.meshes->most_triangles;
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
    for (const GroundSource& source : request_.look.sources) {
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

TilesetLevel TilesetWriter::summed_up(int level) const {
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

Result<TilesetWritten> TilesetWriter::write_json() {
    const TileIndex root{0, 0, layout_.levels() - 1};
    if (!at(root).box) return Error{ErrorKind::no_data, "region", "no triangle has a height at each corner"};
    TilesetWritten written;
    for (int level = root.level; level >= 0; --level) written.levels.push_back(summed_up(level));
    written.box = *at(root).box;
    for (const MeshTile& tile : mesh_tiles_) {
        written.meshes.tiles += tile.name.empty() ? 0 : 1;
        written.meshes.triangles += tile.triangles;
        written.meshes.bytes += tile.bytes;
        written.meshes.largest_error_m = std::max(written.meshes.largest_error_m, tile.error_m);
    }
    if (!mesh_tiles_.empty()) written.box = joined(written.box, mesh_tiles_.front().box);
    tileset_error_m_ = std::max(size_m(written.box), written.meshes.largest_error_m);
    for (const TilesetLevel& level : written.levels)
        tileset_error_m_ = std::max(tileset_error_m_, level.largest_error_m);
    written.geometric_error_m = tileset_error_m_;
    written.root_error_m = at(root).error_m;
    Json json = Json::object();
    json["asset"]["version"] = "1.1";
    json["asset"]["generator"] = request_.look.generator;
    if (!request_.metadata.empty()) json.update(metadata_json());
    json["geometricError"] = tileset_error_m_;
    json["root"] = root_json(root, written);
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

std::uint64_t tileset_tiles(const PostGrid& grid) {
    return TilesetLayout(grid.rows(), grid.columns()).all();
}

Result<TilesetWritten> write_tileset(const std::string& folder, const PostGrid& grid,
                                     const GroundSourceOfTiles& ground, const TilesetRequest& request,
                                     const TilesetProgress& progress) {
    TileMaker maker(grid, request);
    ORO_CHECK(maker.begin(ground));
    TilesetWriter writer(folder, maker, request);
    ORO_CHECK(writer.write_tiles(progress));
    ORO_CHECK(writer.write_meshes());
    return writer.write_json();
}

Result<std::uint64_t> make_tiles(const PostGrid& grid, const GroundSourceOfTiles& ground,
                                 const TilesetRequest& request, const TilesetProgress& progress) {
    TileMaker maker(grid, request);
    ORO_CHECK(maker.begin(ground));
    const TilesetLayout& layout = maker.layout();
    std::uint64_t own = 0;
    double done = 0.0;
    for (int level = 0; level < layout.levels(); ++level) {
        maker.begin_level(level);
        for (std::size_t number = 0; number < layout.count(level); ++number)
            own += maker.is_own(number) ? 1 : 0;
        ORO_CHECK(each_tile(
            layout.count(level), request.threads,
            [&](std::size_t number) -> Result<void> {
                if (!maker.is_own(number)) return {};
                ORO_TRY(const KeptTile one, maker.tile(layout.tile(number, level)));
                return {};
            },
            [&](std::size_t now) {
                done += static_cast<double>(now);
                if (progress) progress(done / static_cast<double>(layout.all()));
            }));
    }
    return own;
}

}  // namespace oro
