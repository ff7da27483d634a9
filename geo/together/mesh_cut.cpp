#include "geo/together/mesh_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "geo/together/grid_clip.h"

namespace oro {
namespace {

// From above: degrees.
using PlanPlace = std::pair<double, double>;
PlanPlace plan_place(const PlacedVertex& vertex) {
    return {vertex.lat_deg, vertex.lon_deg};
}

// Twice the area of a polygon that begins and ends at `from`, in square degrees, by one of its sides.
double area_share(const PlacedVertex& from, const PlacedVertex& a, const PlacedVertex& b) {
    return (a.lat_deg - from.lat_deg) * (b.lon_deg - from.lon_deg) -
           (b.lat_deg - from.lat_deg) * (a.lon_deg - from.lon_deg);
}

// The outline of a mesh from above.
class MeshOutline {
  public:
    explicit MeshOutline(const PlacedMesh& mesh) : mesh_(mesh) {
        std::map<std::pair<PlanPlace, PlanPlace>, std::pair<int, RimEdge>> sides;
        for (const SourceTriangle& triangle : mesh.triangles) {
            triangles_area_ += std::abs(area_share(at(triangle[0]), at(triangle[1]), at(triangle[2])));
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
                const PlanPlace one = plan_place(at(a)), other = plan_place(at(b));
                if (one == other) continue;
                auto& [count, edge] = sides[std::minmax(one, other)];
                ++count;
                edge = {{static_cast<int>(a), 0}, {static_cast<int>(b), 0}};
            }
        }
        for (const auto& [place, side] : sides)
            if (side.first % 2 == 1) edges_.push_back(side.second);
        sort_into_rows();
    }

    // By sides met on the way east: an odd number of them from a place inside.
    [[nodiscard]] bool contains(double lat_deg, double lon_deg) const {
        if (!(lat_deg >= south_deg_ && lat_deg < north_deg_)) return false;
        bool inside = false;
        for (const std::uint32_t number : rows_[row_of(lat_deg)]) {
            const PlacedVertex &a = from(edges_[number]), &b = to(edges_[number]);
            if ((a.lat_deg <= lat_deg) == (b.lat_deg <= lat_deg)) continue;
            const double share = (lat_deg - a.lat_deg) / (b.lat_deg - a.lat_deg);
            if (std::lerp(a.lon_deg, b.lon_deg, share) > lon_deg) inside = !inside;
        }
        return inside;
    }

    // Whether no triangle lies over another: together they are as large as what the outline surrounds.
    [[nodiscard]] bool is_plain() const {
        constexpr int samples = 1024;  // rows
        double inside = 0.0;
        if (rows_.empty()) return false;
        for (int i = 0; i < samples; ++i) {
            const double lat_deg = std::lerp(south_deg_, north_deg_, (i + 0.5) / samples);
            std::vector<double> crossings;
            for (const std::uint32_t number : rows_[row_of(lat_deg)]) {
                const PlacedVertex &a = from(edges_[number]), &b = to(edges_[number]);
                if ((a.lat_deg <= lat_deg) == (b.lat_deg <= lat_deg)) continue;
                const double share = (lat_deg - a.lat_deg) / (b.lat_deg - a.lat_deg);
                crossings.push_back(std::lerp(a.lon_deg, b.lon_deg, share));
            }
            std::ranges::sort(crossings);
            for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
                inside += crossings[k + 1] - crossings[k];
        }
        inside *= (north_deg_ - south_deg_) / samples;
        constexpr double sampling = 0.02;
        return std::abs(0.5 * triangles_area_ - inside) <= sampling * inside;
    }

    [[nodiscard]] ClipCover cover() const {
        ClipCover cover;
        cover.has_ground = [this](double lat_deg, double lon_deg) { return contains(lat_deg, lon_deg); };
        for (const RimEdge& edge : edges_) {
            const PlacedVertex &a = from(edge), &b = to(edge);
            cover.rim.push_back({edge, {PostPlace{a.lat_deg, a.lon_deg}, PostPlace{b.lat_deg, b.lon_deg}}});
        }
        return cover;
    }

  private:
    [[nodiscard]] const PlacedVertex& at(std::uint32_t vertex) const { return mesh_.vertices[vertex]; }
    [[nodiscard]] const PlacedVertex& from(const RimEdge& edge) const {
        return at(static_cast<std::uint32_t>(edge.from.row));
    }
    [[nodiscard]] const PlacedVertex& to(const RimEdge& edge) const {
        return at(static_cast<std::uint32_t>(edge.to.row));
    }
    [[nodiscard]] std::size_t row_of(double lat_deg) const {
        const double share = (lat_deg - south_deg_) / (north_deg_ - south_deg_);
        return static_cast<std::size_t>(std::clamp(share * static_cast<double>(rows_.size()), 0.0,
                                                   static_cast<double>(rows_.size() - 1)));
    }
    void sort_into_rows() {
        for (const RimEdge& edge : edges_)
            for (const PlacedVertex* end : {&from(edge), &to(edge)}) {
                south_deg_ = std::min(south_deg_, end->lat_deg);
                north_deg_ = std::max(north_deg_, end->lat_deg);
            }
        if (!(south_deg_ < north_deg_)) return;
        rows_.resize(1 + edges_.size() / 4);
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            const auto [low, high] = std::minmax(from(edges_[i]).lat_deg, to(edges_[i]).lat_deg);
            for (std::size_t row = row_of(low); row <= row_of(high); ++row) rows_[row].push_back(i);
        }
    }

    const PlacedMesh& mesh_;
    std::vector<RimEdge> edges_;  // rows of their posts are numbers of vertices
    std::vector<std::vector<std::uint32_t>> rows_;
    double south_deg_{90.0}, north_deg_{-90.0}, triangles_area_{};
};

// What is left of cut triangles, as a mesh's own.
class RimOfCut {
  public:
    RimOfCut(const HeightField& field, PlacedMesh& mesh) : field_(field), mesh_(mesh) {}

    void add(const GridClip& clip) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> shared;
        for (const SeamWall& wall : clip.walls) {
            const std::uint32_t a = vertex(wall.cut[0]), b = vertex(wall.cut[1]);
            ++shared[{a, b}], ++shared[{b, a}];
            mesh_.rim_walls.push_back({{a, b}, {vertex(wall.over[0]), vertex(wall.over[1])}});
        }
        std::vector<SourceTriangle> added;
        for (const SeamTriangle& piece : clip.ground) {
            SourceTriangle& triangle = added.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) triangle[i] = vertex(piece.points[i]);
            for (std::size_t i = 0; i < 3; ++i) ++shared[{triangle[i], triangle[(i + 1) % 3]}];
        }
        // Where the grid's own triangles go on, as placed by another program.
        for (const SourceTriangle& triangle : added)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
                if (!shared.contains({b, a})) mesh_.rim_walls.push_back({{b, a}, {b, a}});
            }
        mesh_.triangles.insert(mesh_.triangles.end(), added.begin(), added.end());
        if (mesh_.feature_of.empty()) return;
        mesh_.features.push_back({"rim", "", "", {}, mesh_.triangles.size() - added.size()});
        mesh_.feature_of.resize(mesh_.triangles.size(),
                                static_cast<std::uint32_t>(mesh_.features.size() - 1));
    }

  private:
    std::uint32_t vertex(const SeamPoint& point) {
        if (point.grid > 0) return on_outline(point);
        double row = 0.0, column = 0.0, H_m = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            if (point.shares[i] == 0.0) continue;
            row += point.shares[i] * point.posts[i].row;
            column += point.shares[i] * point.posts[i].column;
            H_m += point.shares[i] *
                   static_cast<double>(field_.H_at_post_m(point.posts[i].row, point.posts[i].column));
        }
        constexpr double steps = 0.2 / seam_slack_posts;
        const auto [found, is_new] =
            vertices_.try_emplace({std::llround(row * steps), std::llround(column * steps)},
                                  static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) {
            const PostPlace place = field_.grid.place_at(row, column);
            mesh_.vertices.push_back({place.lat_deg, place.lon_deg, H_m});
        }
        return found->second;
    }
    std::uint32_t on_outline(const SeamPoint& point) {
        const auto a = static_cast<std::uint32_t>(point.posts[0].row),
                   b = static_cast<std::uint32_t>(point.posts[1].row);
        if (point.shares[0] == 1.0) return a;
        if (point.shares[1] == 1.0) return b;
        const PlacedVertex one = mesh_.vertices[a], other = mesh_.vertices[b];
        const double share = point.shares[1];
        if (!mesh_.colours.empty()) {
            // Vertices that were added before have none.
            mesh_.colours.resize(mesh_.vertices.size());
            mesh_.colours.push_back(colour_between(mesh_.colours[a], mesh_.colours[b], share));
        }
        mesh_.vertices.push_back({std::lerp(one.lat_deg, other.lat_deg, share),
                                  std::lerp(one.lon_deg, other.lon_deg, share),
                                  std::lerp(one.H_m, other.H_m, share)});
        return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
    }

    const HeightField& field_;
    PlacedMesh& mesh_;
    std::map<std::pair<long long, long long>, std::uint32_t> vertices_;
};

Error no_cut(const PlacedMesh& mesh, const std::string& why) {
    return {ErrorKind::usage, "--cut-under", mesh.path + ": " + why};
}

}  // namespace

Result<void> cut_under(HeightField& field, PlacedMesh& mesh) {
    if (field.posts) return no_cut(mesh, "a baked region is not cut: name its elevation files");
    GridClip clip;
    {
        const MeshOutline outline(mesh);
        if (!outline.is_plain())
            return no_cut(mesh, "its triangles lie over each other from above: it has no one outline");
        const std::vector<ClipCover> covers{outline.cover()};
        ORO_TRY(clip, clip_by_covers(field, covers));
    }
    RimOfCut(field, mesh).add(clip);
    for (std::size_t post = 0; post < clip.masked_posts.size(); ++post)
        if (clip.masked_posts[post] != 0) field.H_m[post] = void_height_m;
    return {};
}

}  // namespace oro
