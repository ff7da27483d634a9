#include "core/mesh_file/mesh_check.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/mesh_graph/distance_cover.h"
#include "core/mesh_graph/nearest_triangles.h"
#include "core/mesh_graph/original_pieces.h"

namespace oro {
namespace {

using Corners = std::array<glm::dvec3, 3>;

// What a polygon so small is off by need not be known.
constexpr double slack_m = 1.0e-4, least_m = 1.0e-3;

// Where a cover begins to look closer: at the error below, as the builder does, or at what is stated.
enum class Begin { below, stated };

class ErrorCheck {
  public:
    ErrorCheck(const StoredMesh& mesh, int threads, const MeshGround* ground)
        : graph_(mesh.graph.clusters),
          threads_(threads),
          vertices_m_(vertices_of(mesh)),
          original_of_(mesh.graph.original_of),
          mesh_(leaves()) {
        if (ground == nullptr || ground->triangles.empty()) return;
        ground_.emplace(ground->triangles);
        ground_off_m_ = ground->off_m;
    }

    std::optional<std::string> run(Begin begin) {
        begin_ = begin;
        begin_pieces();
        for (std::size_t first = 0; first < graph_.groups.size();) {
            std::size_t end = first;
            while (end < graph_.groups.size() && graph_.groups[end].level == graph_.groups[first].level)
                ++end;
            if (std::string wrong = level(first, end); !wrong.empty()) return wrong;
            first = end;
        }
        return std::nullopt;
    }

  private:
    static std::vector<glm::dvec3> vertices_of(const StoredMesh& mesh) {
        std::vector<glm::dvec3> vertices;
        vertices.reserve(mesh.places.size());
        for (std::uint32_t i = 0; i < mesh.places.size(); ++i) vertices.push_back(mesh.from_origin_m(i));
        return vertices;
    }
    [[nodiscard]] Corners corners_of(std::uint32_t triangle) const {
        const VertexTriangle& corners = graph_.triangles[triangle];
        return {vertices_m_[corners[0]], vertices_m_[corners[1]], vertices_m_[corners[2]]};
    }
    [[nodiscard]] std::vector<Corners> leaves() const {
        std::vector<Corners> all;
        for (const Cluster& cluster : graph_.clusters) {
            if (cluster.made_by != no_group) break;
            for (std::uint32_t i = 0; i < cluster.triangles; ++i)
                all.push_back(corners_of(cluster.first_triangle + i));
        }
        return all;
    }
    void begin_pieces();
    void hand_over(const std::vector<HandedPieces>& handed, std::size_t groups_above);
    std::string level(std::size_t first, std::size_t end);
    std::string group(std::size_t number, std::size_t first, std::size_t next_first, HandedPieces& handed);

    const ClusterGraph& graph_;
    int threads_;
    std::vector<glm::dvec3> vertices_m_;
    std::span<const std::uint32_t> original_of_;
    NearestTriangles mesh_;
    std::optional<NearestTriangles> ground_;
    double ground_off_m_{};
    Begin begin_{};
    std::vector<OriginalPieces> pieces_;  // that each group of the level answers for
};

// Each group of the first level answers for its own triangles.
void ErrorCheck::begin_pieces() {
    std::vector<std::uint32_t> user;
    std::size_t groups = 0;
    for (const Cluster& cluster : graph_.clusters) {
        if (cluster.made_by != no_group) break;
        user.insert(user.end(), cluster.triangles, cluster.used_by);
    }
    while (groups < graph_.groups.size() && graph_.groups[groups].level == 1) ++groups;
    pieces_.resize(groups);
    for (std::uint32_t block = 0; block < mesh_.blocks().size(); ++block)
        for (std::uint32_t i = 0; i < mesh_.blocks()[block].count; ++i)
            pieces_[user[mesh_.number(4 * block + i)]].whole.push_back(WholePiece::triangle(4 * block + i));
    for (OriginalPieces& of_group : pieces_) join_whole_pieces(mesh_, of_group.whole);
}

std::string ErrorCheck::group(std::size_t number, std::size_t first, std::size_t next_first,
                              HandedPieces& handed) {
    const ClusterGroup& group = graph_.groups[number];
    const OriginalPieces& pieces = pieces_[number - first];
    std::vector<Corners> made;
    std::vector<int> users;
    const double most_m = std::max(group.error_m, least_m);
    // Below this nothing is looked at closer: it grows to as much.
    const auto begin_m = [](double as_much_m) {
        return std::max(0.0, std::min(as_much_m / 1.02, as_much_m - 0.001));
    };
    DistanceCover to_mesh(mesh_, begin_m(most_m));
    to_mesh.end_above(most_m + slack_m);
    for (std::uint32_t i = 0; i < group.made; ++i) {
        const Cluster& cluster = graph_.clusters[group.first_made + i];
        for (std::uint32_t k = cluster.first_triangle; k < cluster.first_triangle + cluster.triangles; ++k) {
            made.push_back(corners_of(k));
            users.push_back(cluster.used_by == no_group ? 0 : static_cast<int>(cluster.used_by - next_first));
            if (graph_.triangles[k] == graph_.triangles[original_of_[k]]) continue;
            OriginalPart polygon;
            std::copy(made.back().begin(), made.back().end(), polygon.corners.begin());
            polygon.count = 3;
            to_mesh.cover(polygon);
        }
    }
    char text[200];
    const auto said = [&](double found_m, const char* what) {
        std::snprintf(text, sizeof text,
                      "has a group %zu that states an error of %.6g m, and %s is %.6g m off", number,
                      group.error_m, what, found_m);
        return std::string(text);
    };
    if (to_mesh.bound_m() > most_m + slack_m) return said(to_mesh.bound_m(), "a place of what it made");
    if (pieces.whole.empty() && pieces.parts.empty()) return "";
    if (made.empty()) {
        std::snprintf(text, sizeof text, "has a group %zu that made nothing", number);
        return text;
    }
    const NearestTriangles tree(made);
    DistanceCover from_mesh(
        tree,
        begin_ == Begin::below ? largest_member_error_m(graph_, group) : begin_m(most_m - ground_off_m_),
        users);
    from_mesh.end_above(most_m + slack_m - ground_off_m_);
    if (ground_) from_mesh.put_on_ground_first(*ground_);
    handed = hand_on(mesh_, pieces, from_mesh, {});
    const double found_m = handed.bound_m + ground_off_m_;
    if (found_m > most_m + slack_m) return said(found_m, "a place of the mesh");
    return "";
}

std::string ErrorCheck::level(std::size_t first, std::size_t end) {
    std::vector<HandedPieces> handed(end - first);
    std::vector<std::string> wrong(end - first);
    in_parallel(static_cast<int>(end - first), threads_, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        wrong[at] = group(first + at, first, end, handed[at]);
    });
    const auto found = std::find_if(wrong.begin(), wrong.end(), [](const auto& one) { return !one.empty(); });
    if (found != wrong.end()) return *found;
    std::size_t next_end = end;
    while (next_end < graph_.groups.size() && graph_.groups[next_end].level == graph_.groups[first].level + 1)
        ++next_end;
    hand_over(handed, next_end - end);
    return "";
}

// For what lies on the ground no group answers any more.
void ErrorCheck::hand_over(const std::vector<HandedPieces>& handed, std::size_t groups_above) {
    std::vector<OriginalPieces> next(groups_above);
    if (next.empty()) return;
    for (const HandedPieces& one : handed) {
        for (const auto& [piece, user] : one.whole)
            if (user != on_ground) next[static_cast<std::size_t>(user)].whole.push_back(piece);
        for (const auto& [part, user] : one.parts)
            if (user != on_ground) next[static_cast<std::size_t>(user)].parts.push_back(part);
    }
    pieces_ = std::move(next);
    in_parallel(static_cast<int>(pieces_.size()), threads_,
                [&](int i) { join_whole_pieces(mesh_, pieces_[static_cast<std::size_t>(i)].whole); });
}

}  // namespace

std::optional<std::string> understated_error(const StoredMesh& mesh, int threads, const MeshGround* ground) {
    ErrorCheck check(mesh, threads, ground);
    auto wrong = check.run(Begin::below);
    // Either way that ends well is a proof. Files of older programs went another way than the first.
    if (wrong && !check.run(Begin::stated)) wrong.reset();
    return wrong;
}

}  // namespace oro
