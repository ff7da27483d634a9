#include "geo/tilesets/seam_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "geo/tilesets/cut_rims.h"
#include "geo/tilesets/triangle_box.h"

namespace oro {
namespace {

constexpr double beyond_all = 1.0e9;

class SeamMeshBuilder {
  public:
    SeamMeshBuilder(const Seam& seam, std::span<const std::uint32_t> pieces,
                    std::span<const std::uint32_t> skirts, const PostGrid& grid, const WallReach& reach,
                    const SeamLattice& lattice, bool normals)
        : seam_(seam),
          pieces_(pieces),
          skirts_(skirts),
          grid_(grid),
          reach_(reach),
          lattice_(lattice),
          normals_(normals) {
        mesh_.step_m = lattice.step_m;
        mesh_.ecef_from_mesh = lattice.ecef_from_axes;
    }
    GroundMesh build();

  private:
    // A rounded position with its rounded normal.
    using Key = std::tuple<int, int, int, int, int, int>;
    // Where skirts meet, to the step.
    using Corner = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

    void place();
    template <class Use>
    void each_corner(const Use& use) const;
    [[nodiscard]] glm::dvec3 steps_to(const glm::dvec3& at_m) const {
        return glm::round(glm::transpose(lattice_.ecef_from_axes) * (at_m - lattice_.origin_m) /
                          lattice_.step_m);
    }
    std::uint32_t vertex(const glm::dvec3& at_m, const SeamCorner& corner);
    void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void add_skirt(const SeamSkirt& skirt);
    void find_sides();
    [[nodiscard]] glm::dvec3 below(const SeamSkirt& skirt, std::size_t end) const;
    static Corner corner_of(const glm::dvec3& at_m) {
        constexpr double steps = 256.0;
        return {std::llround(steps * at_m.x), std::llround(steps * at_m.y), std::llround(steps * at_m.z)};
    }

    const Seam& seam_;
    std::span<const std::uint32_t> pieces_, skirts_;
    const PostGrid& grid_;
    WallReach reach_;
    const SeamLattice& lattice_;
    bool normals_;
    GroundMesh mesh_;
    glm::dvec3 centre_steps_{};
    std::map<Key, std::uint32_t> numbers_;
    std::map<Corner, std::vector<glm::dvec3>> sides_;
};

template <class Use>
void SeamMeshBuilder::each_corner(const Use& use) const {
    for (const std::uint32_t number : pieces_)
        for (const SeamCorner& corner : seam_.pieces[number].corners) use(corner);
    for (const std::uint32_t number : skirts_)
        for (std::size_t end = 0; end < 2; ++end) {
            use(seam_.skirts[number].top[end]);
            use(seam_.skirts[number].foot[end]);
        }
}

// The middle of its corners is the centre, to a step.
void SeamMeshBuilder::place() {
    glm::dvec3 low(beyond_all), high(-beyond_all);
    each_corner([&](const SeamCorner& corner) {
        low = glm::min(low, corner.at.m);
        high = glm::max(high, corner.at.m);
    });
    centre_steps_ = steps_to(0.5 * (low + high));
    mesh_.centre_m = lattice_.origin_m + lattice_.ecef_from_axes * (lattice_.step_m * centre_steps_);
}

// The place on the map and the light are those of the corner, wherever below it the vertex is.
std::uint32_t SeamMeshBuilder::vertex(const glm::dvec3& at_m, const SeamCorner& corner) {
    const glm::dmat3 mesh_from_ecef = glm::transpose(mesh_.ecef_from_mesh);
    const glm::ivec3 at(steps_to(at_m) - centre_steps_);
    const glm::vec3 normal(mesh_from_ecef * corner.normal);
    constexpr float fineness = 127.0F;
    const glm::ivec3 rounded(normals_ ? glm::round(fineness * normal) : glm::vec3(0.0F));
    const auto [known, is_new] = numbers_.try_emplace({at.x, at.y, at.z, rounded.x, rounded.y, rounded.z},
                                                      static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!is_new) return known->second;
    mesh_.positions.push_back(at);
    if (normals_) mesh_.normals.push_back(normal);
    const Geodetic place = geodetic_from_ecef(corner.at);
    const PostNumber post = grid_.post_at(place.lat_deg, place.lon_deg);
    mesh_.places.push_back({std::clamp(post.row, 0.0, grid_.rows() - 1.0),
                            std::clamp(post.column, 0.0, grid_.columns() - 1.0), place.lat_deg,
                            place.lon_deg});
    return known->second;
}

void SeamMeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || c == a) return;
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
}

// Of every skirt of the seam, those in other tiles too: their walls then meet.
void SeamMeshBuilder::find_sides() {
    for (const SeamSkirt& skirt : seam_.skirts)
        for (const SeamCorner& foot : skirt.foot) sides_[corner_of(foot.at.m)].push_back(skirt.side);
}

glm::dvec3 SeamMeshBuilder::below(const SeamSkirt& skirt, std::size_t end) const {
    const glm::dvec3 foot_m = skirt.foot[end].at.m;
    const std::vector<glm::dvec3>& sides = sides_.at(corner_of(foot_m));
    glm::dvec3 out = skirt.side;
    if (sides.size() == 2) out = across_both(sides[0], sides[1], CutRims::longest_outwards);
    return foot_m + reach_.out_m * out - reach_.down_m * skirt.up;
}

// The wall runs as the step does, and both face where `side` points.
void SeamMeshBuilder::add_skirt(const SeamSkirt& skirt) {
    std::array<std::uint32_t, 2> top{}, foot{}, down{};
    for (std::size_t end = 0; end < 2; ++end) {
        top[end] = vertex(skirt.top[end].at.m, skirt.top[end]);
        foot[end] = vertex(skirt.foot[end].at.m, skirt.foot[end]);
        down[end] = vertex(below(skirt, end), skirt.foot[end]);
    }
    for (const auto& [upper, lower] : {std::pair{top, foot}, std::pair{foot, down}}) {
        add_triangle(upper[0], lower[1], lower[0]);
        add_triangle(upper[0], upper[1], lower[1]);
    }
}

GroundMesh SeamMeshBuilder::build() {
    place();
    find_sides();
    for (const std::uint32_t number : pieces_) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = vertex(seam_.pieces[number].corners[i].at.m, seam_.pieces[number].corners[i]);
        add_triangle(corners[0], corners[1], corners[2]);
    }
    mesh_.ground_triangles = mesh_.indices.size() / 3;
    for (const std::uint32_t number : skirts_) add_skirt(seam_.skirts[number]);
    mesh_.box = box_of(mesh_);
    return std::move(mesh_);
}

}  // namespace

GroundMesh seam_mesh(const Seam& seam, std::span<const std::uint32_t> pieces,
                     std::span<const std::uint32_t> skirts, const PostGrid& grid, const WallReach& reach,
                     const SeamLattice& lattice, bool normals) {
    return SeamMeshBuilder(seam, pieces, skirts, grid, reach, lattice, normals).build();
}

}  // namespace oro
