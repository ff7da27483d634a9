#include "core/cluster_file/group_code.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "core/cluster_file/mesh_code.h"
#include "core/cluster_file/point_code.h"
#include "core/clusters/cluster_split.h"
#include "core/surface/distinct_vertices.h"

// The order of a payload: members, rising; then each cluster with its counts, its user, its rectangle, its
// vertices (core/cluster_file/point_code.h) and its triangles (core/cluster_file/mesh_code.h). What is
// learned of likely numbers begins anew with each group.
namespace oro {
namespace {

// A cluster's vertices and triangles, counted from the north-west corner of the rectangle that they are in.
struct LocalMesh {
    std::int32_t row{};
    std::int32_t column{};
    std::uint32_t rows{1};
    std::uint32_t columns{1};
    std::vector<GridPosition> points;
    std::vector<LocalTriangle> triangles;
};

LocalMesh local_mesh(std::span<const VertexTriangle> triangles, const PostCounts& posts) {
    const std::vector<VertexNumber> vertices = distinct_vertices(triangles);
    LocalMesh mesh;
    SurfaceVertex lowest = posts.place(vertices.front()), highest = lowest;
    for (const VertexNumber number : vertices) {
        const SurfaceVertex place = posts.place(number);
        lowest = {std::min(lowest.row, place.row), std::min(lowest.column, place.column), 0};
        highest = {std::max(highest.row, place.row), std::max(highest.column, place.column), 0};
    }
    mesh.row = lowest.row;
    mesh.column = lowest.column;
    mesh.rows = static_cast<std::uint32_t>(highest.row - lowest.row + 1);
    mesh.columns = static_cast<std::uint32_t>(highest.column - lowest.column + 1);
    for (const VertexNumber number : vertices) {
        const SurfaceVertex place = posts.place(number);
        mesh.points.push_back({place.row - lowest.row, place.column - lowest.column});
    }
    for (const VertexTriangle& triangle : triangles) {
        LocalTriangle local{};
        for (std::size_t i = 0; i < 3; ++i)
            local[i] = static_cast<std::uint8_t>(
                std::lower_bound(vertices.begin(), vertices.end(), triangle[i]) - vertices.begin());
        mesh.triangles.push_back(local);
    }
    return mesh;
}

// Both ways: a decoder fills what an encoder is given. What is wrong with it is in words, for a decoder.
template <class Coder>
class GroupCode {
  public:
    using Wrong = std::optional<std::string>;
    GroupCode(Coder& coder, const PostCounts& posts, std::uint32_t clusters)
        : coder_(coder), posts_(posts), clusters_(clusters) {}

    Wrong members(GroupPart& part);
    Wrong cluster(Cluster& cluster, std::uint32_t group, LocalMesh& mesh);

  private:
    void used_by(Cluster& cluster, std::uint32_t group);
    Wrong rectangle(LocalMesh& mesh);

    Coder& coder_;
    PostCounts posts_;
    std::uint32_t clusters_;
    SmallNumber step_;
    AdaptiveBit unused_;
    NearZero user_, row_, column_;
    SmallNumber rows_, columns_;
    PointCode points_;
    MeshCode mesh_;
    std::uint32_t last_user_{no_group};
    std::int32_t last_row_{}, last_column_{};
};

template <class Coder>
auto GroupCode<Coder>::members(GroupPart& part) -> Wrong {
    std::uint64_t next = 0;
    for (std::uint32_t i = 0; i < part.group.members; ++i) {
        const std::uint32_t given = Coder::writes ? part.members[i] : 0;
        const std::uint64_t member =
            i == 0 ? coder_.uniform(clusters_, given)
                   : next + step_.code(coder_, given - static_cast<std::uint32_t>(next));
        if (member >= clusters_)
            return "uses cluster " + std::to_string(member) + " of " + std::to_string(clusters_);
        if constexpr (!Coder::writes) {
            if (coder_.is_wrong()) return "ends within its members";
            part.members.push_back(static_cast<std::uint32_t>(member));
        }
        next = member + 1;
    }
    return std::nullopt;
}

// As the distance from the user of the cluster before, or from the group itself.
template <class Coder>
void GroupCode<Coder>::used_by(Cluster& cluster, std::uint32_t group) {
    const bool unused = coder_.bit(unused_, cluster.used_by == no_group);
    if (unused) {
        cluster.used_by = no_group;
        return;
    }
    const std::uint32_t from = last_user_ == no_group ? group : last_user_;
    cluster.used_by = from + static_cast<std::uint32_t>(
                                 user_.code(coder_, static_cast<std::int32_t>(cluster.used_by - from)));
    last_user_ = cluster.used_by;
}

template <class Coder>
auto GroupCode<Coder>::rectangle(LocalMesh& mesh) -> Wrong {
    const std::int64_t row = std::int64_t{last_row_} + row_.code(coder_, mesh.row - last_row_);
    const std::int64_t column = std::int64_t{last_column_} + column_.code(coder_, mesh.column - last_column_);
    const std::int64_t rows = std::int64_t{rows_.code(coder_, mesh.rows - 1)} + 1;
    const std::int64_t columns = std::int64_t{columns_.code(coder_, mesh.columns - 1)} + 1;
    if (row < 0 || column < 0 || row + rows > posts_.rows || column + columns > posts_.columns)
        return "has posts in rows " + std::to_string(row) + " to " + std::to_string(row + rows - 1) +
               " and columns " + std::to_string(column) + " to " + std::to_string(column + columns - 1) +
               ", expected some of " + std::to_string(posts_.rows) + " x " + std::to_string(posts_.columns);
    last_row_ = mesh.row = static_cast<std::int32_t>(row);
    last_column_ = mesh.column = static_cast<std::int32_t>(column);
    mesh.rows = static_cast<std::uint32_t>(rows);
    mesh.columns = static_cast<std::uint32_t>(columns);
    return std::nullopt;
}

template <class Coder>
auto GroupCode<Coder>::cluster(Cluster& cluster, std::uint32_t group, LocalMesh& mesh) -> Wrong {
    static_assert(most_cluster_triangles == 128 && most_cluster_vertices == 128);
    cluster.triangles = coder_.uniform(most_cluster_triangles, cluster.triangles - 1) + 1;
    cluster.vertices = coder_.uniform(most_cluster_vertices, cluster.vertices - 1) + 1;
    used_by(cluster, group);
    if (const Wrong wrong = rectangle(mesh)) return wrong;
    if (cluster.vertices > std::uint64_t{mesh.rows} * mesh.columns)
        return "has a cluster of " + std::to_string(cluster.vertices) + " vertices in a rectangle of " +
               std::to_string(mesh.rows) + " x " + std::to_string(mesh.columns) + " posts";
    points_.code(coder_, static_cast<std::int32_t>(mesh.rows), static_cast<std::int32_t>(mesh.columns),
                 cluster.vertices, mesh.points);
    if (!mesh_.code(coder_, mesh.points, cluster.triangles, mesh.triangles))
        return "has a cluster whose triangles do not fit together";
    return std::nullopt;
}

}  // namespace

GroupPart part_of(const ClusterGraph& graph, std::uint32_t number) {
    GroupPart part{number, graph.groups[number], {}, {}, {}};
    const auto members = graph.members_of(part.group);
    part.members.assign(members.begin(), members.end());
    for (std::uint32_t i = part.group.first_made; i < part.group.first_made + part.group.made; ++i) {
        const auto triangles = graph.triangles_of(graph.clusters[i]);
        part.made.push_back(graph.clusters[i]);
        part.made.back().first_triangle = static_cast<std::uint32_t>(part.triangles.size());
        part.triangles.insert(part.triangles.end(), triangles.begin(), triangles.end());
    }
    return part;
}

Result<std::vector<std::byte>> encode_group(const GroupPart& part, const PostCounts& posts,
                                            std::uint32_t clusters) {
    const auto fault = [&](const std::string& what) {
        return Error{ErrorKind::failed, "group " + std::to_string(part.number), what};
    };
    if (part.triangles.size() > most_group_triangles || part.members.size() > most_group_members)
        return fault("has " + std::to_string(part.triangles.size()) + " triangles and " +
                     std::to_string(part.members.size()) + " members, more than a file holds");
    RangeEncoder coder;
    GroupCode<RangeEncoder> code(coder, posts, clusters);
    GroupPart given{part.number, part.group, part.members, {}, {}};
    if (const auto wrong = code.members(given)) return fault(*wrong);
    for (Cluster cluster : part.made) {
        const auto triangles = std::span(part.triangles).subspan(cluster.first_triangle, cluster.triangles);
        LocalMesh mesh = local_mesh(triangles, posts);
        assert(mesh.points.size() == cluster.vertices);
        if (walk_order(mesh.triangles, static_cast<int>(mesh.points.size())) != mesh.triangles)
            return fault("has triangles that are not in the order of a walk");
        if (const auto wrong = code.cluster(cluster, part.number, mesh)) return fault(*wrong);
    }
    std::vector<std::byte> bytes = coder.finish();
    const std::uint64_t most = most_group_bytes(part.triangles.size(), part.made.size(), part.members.size());
    if (bytes.size() > most)
        return fault("takes " + std::to_string(bytes.size()) + " bytes, more than the " +
                     std::to_string(most) + " that a file holds of it");
    return bytes;
}

std::optional<std::string> decode_group(std::span<const std::byte> bytes, const PostCounts& posts,
                                        std::uint32_t clusters, GroupPart& part) {
    part.members.clear();
    part.made.clear();
    part.triangles.clear();
    RangeDecoder coder(bytes);
    GroupCode<RangeDecoder> code(coder, posts, clusters);
    if (auto wrong = code.members(part)) return wrong;
    LocalMesh mesh;
    for (std::uint32_t i = 0; i < part.group.made; ++i) {
        Cluster cluster{static_cast<std::uint32_t>(part.triangles.size()), 1, 1, part.number, 0};
        auto wrong = code.cluster(cluster, part.number, mesh);
        if (coder.is_wrong()) return "ends within cluster " + std::to_string(i);
        if (wrong) return wrong;
        part.made.push_back(cluster);
        for (const LocalTriangle& local : mesh.triangles) {
            VertexTriangle& triangle = part.triangles.emplace_back();
            for (std::size_t j = 0; j < 3; ++j) {
                const GridPosition& point = mesh.points[local[j]];
                triangle[j] = posts.number(mesh.row + point.row, mesh.column + point.column);
            }
        }
        if (part.triangles.size() > most_group_triangles)
            return "has more than " + std::to_string(most_group_triangles) + " triangles";
    }
    if (!coder.at_end()) return "has more bytes than its clusters ask for";
    return std::nullopt;
}

}  // namespace oro
