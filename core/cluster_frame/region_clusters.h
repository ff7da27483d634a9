// A region's cluster graph as frames are made of it: what each group is, and on request its clusters, their
// spheres, and what the GPU gets of them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"
#include "core/cluster_frame/group_cache.h"
#include "core/clusters/cluster_graph.h"
#include "core/earth/culling.h"
#include "core/frame/height_quantization.h"
#include "core/surface/grid_surface.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro {

// Reads a group whole, by its number. Errors: as ClusterFile::part().
using ReadGroup = std::function<Result<void>(std::uint32_t number, GroupPart& part)>;
// Of a group that was read and is no part of a graph; what: in words that follow "group N".
using UnsoundGroupError = std::function<Error(std::uint32_t number, const std::string& what)>;

// Each group that is read is held against those below it and against what it covers, so that the rule of the
// cut may trust its error and its sphere: that is damage, too. (Whether the ground is covered once is a
// question to the whole graph: ClusterFile::check().)
//
// For one thread at a time, but for what says otherwise. Keeps 5 bytes a post, and what was asked for: some
// 40 bytes a triangle of the graph above the leaves, as much of it as may be held (GroupCache). What gave way
// is read again when it is asked for.
class RegionClusters {
  public:
    // groups: of the whole graph, in its order; leaves: number of clusters before theirs, which `field` must
    // have, too. occluder: of the region's horizon. unsound: names the place of what `read` gave. Errors:
    // groups that are no graph over these posts.
    static Result<std::unique_ptr<RegionClusters>> create(const HeightField& field,
                                                          const HorizonOccluder& occluder,
                                                          std::vector<ClusterGroup> groups,
                                                          std::uint32_t leaves, ReadGroup read,
                                                          UnsoundGroupError unsound = {});

    [[nodiscard]] std::span<const ClusterGroup> groups() const { return groups_; }
    [[nodiscard]] std::uint32_t leaves() const { return leaves_count_; }
    // Those of the coarsest clusters, which no group uses.
    [[nodiscard]] std::span<const std::uint32_t> roots() const { return roots_; }
    // The group that made a cluster; no_group: a leaf.
    [[nodiscard]] std::uint32_t maker(std::uint32_t cluster) const { return makers_[cluster]; }
    // Its level in the graph: 0, the original's.
    [[nodiscard]] std::uint32_t level_of(std::uint32_t cluster) const {
        return maker(cluster) == no_group ? 0 : groups_[maker(cluster)].level;
    }
    // What groups and reaches may take, bytes: those that are hidden give way first, then those least
    // recently asked for, but none that was asked for since the frame began. Without this, or without frames,
    // nothing gives way.
    void hold_at_most(std::uint64_t bytes) { held_.hold_at_most(bytes); }
    void begin_frame() { held_.begin_frame(); }
    void mark_occluded(std::vector<std::uint32_t> groups) { held_.mark_occluded(std::move(groups)); }
    void end_frame() { held_.end_frame(); }
    [[nodiscard]] const GroupCache& held() const { return held_; }
    // Reads groups, and the reach of clusters, that are not here, by several threads. Errors: damage.
    Result<void> read(std::span<const std::uint32_t> groups);
    Result<void> reach_all(std::span<const std::uint32_t> clusters);
    // Looks at the coarsest groups, which nothing above vouches for, whether or not they are seen. Errors:
    // damage.
    [[nodiscard]] Result<void> check_coarsest() const;
    // Clusters that a group uses, good as long as the frame. Errors: damage.
    Result<std::span<const std::uint32_t>> members(std::uint32_t group);
    Result<ClusterReach> reach(std::uint32_t cluster);
    // Errors: damage.
    Result<std::uint32_t> triangle_count(std::uint32_t cluster);
    // What the GPU gets of a cluster, with heights coded so; gives DrawnCluster::counts. Errors: damage.
    Result<std::uint32_t> fill(std::uint32_t cluster, const HeightQuantization& coding,
                               gpu::ClusterBlock& block);
    [[nodiscard]] const PostGrid& grid() const { return grid_; }

    // For those who do not wait: what is here, and where a cluster is, null where that is not known here.
    [[nodiscard]] const GroupPart* read_part(std::uint32_t group) const { return held_.find(group); }
    [[nodiscard]] const ClusterReach* known_reach(std::uint32_t cluster) const {
        return held_.reach(cluster);
    }
    // The same of a group that the frame needs: it stays while that lasts.
    const GroupPart* use_part(std::uint32_t group) { return held_.use(group); }
    struct LoadedCluster {
        std::uint32_t number{};
        std::uint32_t counts{};  // DrawnCluster::counts
        std::unique_ptr<gpu::ClusterBlock> block;
        ClusterReach reach{};
    };
    // A group with the reach of what it made, and of leaves that it uses.
    struct LoadedGroup {
        std::uint32_t number{};
        std::unique_ptr<GroupPart> part;
        std::vector<std::pair<std::uint32_t, ClusterReach>> reaches;
        std::vector<LoadedCluster> seen;  // of these, as far as they were asked for
    };
    // Which clusters come with their group: those that can be seen of what it made, and of leaves that it
    // uses.
    struct SeenOfGroup {
        std::function<bool(const ClusterReach& reach)> is_seen;
        bool leaves{};
        const HeightQuantization& coding;
    };
    // Any number of threads may load, and ask whether a group is here, beside the one that uses the rest. A
    // cluster's maker is read again where it gave way. Errors: damage.
    [[nodiscard]] bool is_held(std::uint32_t group) const { return held_.share(group) != nullptr; }
    [[nodiscard]] Result<LoadedGroup> load_group(std::uint32_t group,
                                                 const SeenOfGroup* seen = nullptr) const;
    [[nodiscard]] Result<LoadedCluster> load_cluster(std::uint32_t cluster,
                                                     const HeightQuantization& coding) const;
    // What a thread has loaded is here from now on; a reach, where its group is. Takes the group's part.
    void keep(LoadedGroup& group);
    void keep(std::uint32_t cluster, const ClusterReach& reach);

  private:
    RegionClusters(const HeightField& field, const HorizonOccluder& occluder);
    Result<const GroupPart*> part(std::uint32_t group);
    // A group that is sound as far as can be seen from it and from the groups below.
    Result<void> read_sound(std::uint32_t group, GroupPart& part) const;
    [[nodiscard]] std::optional<std::string> wrong_with(const GroupPart& part) const;
    [[nodiscard]] std::optional<std::string> wrong_places(const GroupPart& part) const;
    // A leaf's are put into `leaf`.
    Result<std::span<const VertexTriangle>> triangles(std::uint32_t cluster,
                                                      std::vector<VertexTriangle>& leaf);
    // The same of what was read. part: of its maker; null: it is a leaf.
    [[nodiscard]] std::span<const VertexTriangle> triangles_of(std::uint32_t cluster, const GroupPart* part,
                                                               std::vector<VertexTriangle>& leaf) const;
    [[nodiscard]] Result<LoadedCluster> loaded_cluster(std::uint32_t cluster,
                                                       std::span<const VertexTriangle> triangles,
                                                       const HeightQuantization& coding) const;
    Result<std::uint32_t> fill_with(std::span<const VertexTriangle> triangles, std::uint32_t level,
                                    const HeightQuantization& coding, gpu::ClusterBlock& block) const;
    [[nodiscard]] ClusterReach reach_of(std::span<const VertexTriangle> triangles) const;

    PostGrid grid_;
    HorizonOccluder occluder_;
    DrawnHeights heights_;
    GridSurface surface_;
    GridBounds bounds_;
    std::vector<std::uint32_t> leaf_nodes_;  // GridSurface
    std::uint32_t leaves_count_{};
    std::vector<ClusterGroup> groups_;
    std::vector<std::uint32_t> makers_;  // of each cluster
    std::vector<std::uint32_t> roots_;
    ReadGroup read_;
    UnsoundGroupError unsound_;
    GroupCache held_;
};

// Of a cluster file over the posts of a region. Errors: a file of other posts (told by `fingerprint`),
// damage.
Result<std::unique_ptr<RegionClusters>> clusters_of_file(std::shared_ptr<const ClusterFile> file,
                                                         std::uint64_t fingerprint, const HeightField& field,
                                                         const HorizonOccluder& occluder);
// Of a graph in memory, which outlives them.
Result<std::unique_ptr<RegionClusters>> clusters_of_graph(const ClusterGraph& graph, const HeightField& field,
                                                          const HorizonOccluder& occluder);

}  // namespace oro
