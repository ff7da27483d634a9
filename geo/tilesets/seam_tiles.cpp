#include "geo/tilesets/seam_tiles.h"

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <system_error>
#include <utility>

#include "core/terrain/drawn_heights.h"
#include "geo/files/plain_file.h"
#include "geo/tilesets/each_tile.h"
#include "geo/tilesets/tile_boxes.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

// Of a tile: its positions are whole steps up to 2^23 from its middle, and viewers skip what is not in view.
constexpr double widest_m = 40000.0;

glm::dvec3 middle_of(const SeamPiece& piece) {
    return (piece.corners[0].at.m + piece.corners[1].at.m + piece.corners[2].at.m) / 3.0;
}
glm::dvec3 middle_of(const SeamSkirt& skirt) {
    return 0.25 * (skirt.top[0].at.m + skirt.top[1].at.m + skirt.foot[0].at.m + skirt.foot[1].at.m);
}

// Box of the middles, along the axes of ECEF.
struct Extent {
    glm::dvec3 low{1.0e9}, high{-1.0e9};
    void add(const glm::dvec3& at) {
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
};

// Half of some things by the coordinate of their middles; equal ones by their numbers.
template <class Of>
std::vector<std::uint32_t> taken_above(std::vector<std::uint32_t>& numbers, int axis, double at,
                                       const Of& of) {
    std::vector<std::uint32_t> above;
    std::erase_if(numbers, [&](std::uint32_t number) {
        const bool is_above = middle_of(of[number])[axis] > at;
        if (is_above) above.push_back(number);
        return is_above;
    });
    return above;
}

std::vector<std::uint32_t> all_of(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    return numbers;
}

}  // namespace

SeamTiles::SeamTiles(const TilesetGround& ground, const TilesetRequest& request)
    : ground_(ground), request_(request) {
    if (request.kept != nullptr) kept_ = request.kept->of("between");
    constexpr double share = 1.0 / 16.0, least_m = 0x1.0p-7, most_m = 0x1.0p7;
    double finest_m = most_m;
    for (const TilesetGrid& grid : ground.grids) finest_m = std::min(finest_m, share * grid.finest_error_m);
    lattice_.step_m = std::max(least_m, finest_m);
    lay_lattice();
    for (std::size_t i = 0; i < ground.between.size(); ++i) {
        const Seam& seam = ground.between[i].seam;
        if (!seam.empty()) divide({i, all_of(seam.pieces.size()), all_of(seam.skirts.size())});
    }
}

// Around a corner of what there is.
void SeamTiles::lay_lattice() {
    for (const TilesetBetween& one : ground_.between) {
        if (one.seam.empty()) continue;
        lattice_.origin_m = one.seam.pieces.empty() ? one.seam.skirts.front().top[0].at.m
                                                    : one.seam.pieces.front().corners[0].at.m;
        const Geodetic at = geodetic_from_ecef({lattice_.origin_m});
        lattice_.ecef_from_axes = ecef_from_enu(at.lat_deg, at.lon_deg);
        return;
    }
}

// In halves along the longest side of its box.
void SeamTiles::divide(Tile tile) {
    const Seam& seam = ground_.between[tile.between].seam;
    Extent extent;
    for (const std::uint32_t number : tile.pieces) extent.add(middle_of(seam.pieces[number]));
    for (const std::uint32_t number : tile.skirts) extent.add(middle_of(seam.skirts[number]));
    const glm::dvec3 size = extent.high - extent.low;
    if ((tile.pieces.size() + 2 * tile.skirts.size() <= request_.most_between &&
         glm::length(size) <= widest_m) ||
        glm::length(size) == 0.0) {
        tiles_.push_back(std::move(tile));
        return;
    }
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const double at = 0.5 * (extent.low[axis] + extent.high[axis]);
    Tile above{tile.between, {}, {}};
    above.pieces = taken_above(tile.pieces, axis, at, seam.pieces);
    above.skirts = taken_above(tile.skirts, axis, at, seam.skirts);
    divide(std::move(tile));
    divide(std::move(above));
}

bool SeamTiles::all_kept() const {
    if (!kept_) return tiles_.empty();
    for (std::size_t number = 0; number < tiles_.size(); ++number)
        if (is_own(number) && !kept_->has({0, static_cast<int>(number), 0})) return false;
    return true;
}

// A piece lies on a flat triangle of its grid, which the surface sags from.
EdgeBound SeamTiles::bound_of(std::size_t between) const {
    const TilesetBetween& of = ground_.between[between];
    EdgeBound bound;
    const auto add = [&](const SeamCorner& corner) {
        bound.lowest_h_m = std::min(bound.lowest_h_m, corner.h_m);
        bound.highest_h_m = std::max(bound.highest_h_m, corner.h_m);
    };
    for (const SeamPiece& piece : of.seam.pieces) {
        for (const SeamCorner& corner : piece.corners) add(corner);
        const glm::dvec3 first = piece.corners[0].at.m;
        const glm::dvec3 normal = glm::cross(piece.corners[1].at.m - first, piece.corners[2].at.m - first);
        // Splinters are as steep as rounding makes them.
        constexpr double splinter_m2 = 1.0e-3;
        const double up = glm::dot(normal, glm::normalize(first)), twice_m2 = glm::length(normal);
        if (up > 0.0 && twice_m2 > splinter_m2) bound.steepness = std::max(bound.steepness, twice_m2 / up);
    }
    for (const SeamSkirt& skirt : of.seam.skirts)
        for (std::size_t end = 0; end < 2; ++end) {
            add(skirt.top[end]);
            add(skirt.foot[end]);
        }
    if (of.seam.empty()) return bound;
    const double rise_m = bound.highest_h_m - bound.lowest_h_m;
    const PostGrid& posts = *ground_.grids[of.grid].posts;
    bound.error_m = TileBounds::added_m(posts, bound.highest_h_m, rise_m, lattice_.step_m);
    bound.beside_m = flat_triangle_sag_m(posts, 1.0, 1.0, bound.highest_h_m, rise_m) + lattice_.step_m;
    return bound;
}

double SeamTiles::error_m(std::size_t between) const {
    return bound_of(between).error_m;
}

EdgeBound SeamTiles::bound() const {
    EdgeBound all;
    for (std::size_t i = 0; i < ground_.between.size(); ++i) all.widen(bound_of(i));
    return all;
}

Result<KeptTile> SeamTiles::made(std::size_t number) const {
    const Tile& tile = tiles_[number];
    const TilesetBetween& of = ground_.between[tile.between];
    const TilesetGrid& grid = ground_.grids[of.grid];
    const EdgeBound own = bound_of(tile.between);
    const GroundMesh mesh = seam_mesh(of.seam, tile.pieces, tile.skirts, *grid.posts, wall_reach(own, grids_),
                                      lattice_, request_.normals);
    VertexFacts facts;
    if (grid.facts) {
        ORO_TRY(facts, grid.facts(0, mesh.places));
    }
    GlbLook look = request_.look;
    look.sources = grid.sources;
    // Steps are seen from the side that is lower, whichever that is.
    look.two_sided = true;
    return KeptTile{true, mesh.ground_triangles, own.error_m, mesh.box, glb_bytes(mesh, facts, look)};
}

Result<KeptTile> SeamTiles::tile(std::size_t number) const {
    return kept_or_made(kept_ ? &*kept_ : nullptr, {0, static_cast<int>(number), 0},
                        [&] { return made(number); });
}

Result<void> SeamTiles::write(const std::string& folder) {
    if (tiles_.empty()) return {};
    const std::string path = folder + "/between";
    std::error_code failed;
    if (fs::create_directory(path, failed); failed)
        return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    written_.resize(tiles_.size());
    bytes_.resize(tiles_.size());
    return each_tile(
        tiles_.size(), request_.threads,
        [&](std::size_t number) -> Result<void> {
            ORO_TRY(KeptTile one, tile(number));
            ORO_CHECK(write_plain_file(path + "/" + std::to_string(number) + ".glb", one.glb));
            bytes_[number] = one.glb.size();
            one.glb.clear();
            written_[number] = std::move(one);
            return {};
        },
        [](std::size_t) {});
}

std::optional<TileBox> SeamTiles::box() const {
    std::optional<TileBox> box;
    for (const KeptTile& one : written_) box = box ? joined(*box, one.box) : one.box;
    return box;
}

TilesetLevel SeamTiles::summed_up() const {
    TilesetLevel sum;
    for (std::size_t i = 0; i < written_.size(); ++i) {
        ++sum.tiles;
        sum.triangles += written_[i].triangles;
        sum.bytes += bytes_[i];
        sum.largest_error_m = std::max(sum.largest_error_m, written_[i].error_m);
    }
    return sum;
}

std::vector<nlohmann::ordered_json> SeamTiles::tiles_json() const {
    std::vector<nlohmann::ordered_json> list;
    for (std::size_t i = 0; i < written_.size(); ++i) {
        nlohmann::ordered_json& json = list.emplace_back();
        json["boundingVolume"]["region"] = region_json_of(written_[i].box);
        json["geometricError"] = written_[i].error_m;
        json["content"]["uri"] = "between/" + std::to_string(i) + ".glb";
    }
    return list;
}

}  // namespace oro
