// The cluster file: a cluster graph whose groups are read one by one when they are asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "core/cluster_file/group_code.h"
#include "core/cluster_file/sound_graph.h"
#include "core/clusters/cluster_graph.h"
#include "core/surface/ground_bounds.h"
#include "core/surface/original_surface.h"

namespace oro {

// What a file says of the whole graph.
struct ClusterOutline {
    // That of the region whose posts the graph was built over.
    std::uint64_t fingerprint{};
    PostCounts posts;
    std::uint32_t leaves{};  // clusters of the original; their triangles are the grid's, and not in the file
    std::uint32_t clusters{};  // leaves, too
    std::uint32_t groups{};
    std::uint64_t members{};    // clusters that groups use
    std::uint64_t triangles{};  // above the leaves
    std::vector<GraphLevel> levels;
};

// Writes a graph as PATH.partial, which takes the real name when it is whole, on the disk. posts: those that
// the graph was built over. The same graph makes the same bytes, whatever the number of threads. Errors:
// a name that is taken (unless `overwrite`), a folder that cannot be written to, another program that is
// writing the same file, a group that no file holds (encode_group).
Result<void> write_cluster_graph(const std::string& path, const ClusterGraph& graph, const PostCounts& posts,
                                 std::uint64_t fingerprint, bool overwrite, int threads = 1);

// The same of a graph that nobody has whole: `part` gives a group, all but its level and first_member, to any
// number of threads at once. outline: of all of it, with levels.
using GiveGroup = std::function<Result<void>(std::uint32_t number, GroupPart& part)>;
Result<void> write_cluster_groups(const std::string& path, const ClusterOutline& outline,
                                  const GiveGroup& part, bool overwrite, int threads = 1);

// The original's clusters, where they are too many to be kept; asked by any number of threads at once.
struct LeavesOneByOne {
    std::uint32_t count{};
    std::function<std::vector<VertexTriangle>(std::uint32_t leaf)> triangles;
};

// A cluster file that is read. Opening reads what concerns the whole graph, a few KB; a group's record and
// payload are read when they are asked for, from any number of threads at once. Every damage is an Error with
// the name of the file, the place, what was found and what was expected; so is a file that another program
// writes into while it is open.
//     ORO_TRY(const ClusterFile file, ClusterFile::open("alps.oroc"));
//     ORO_TRY(const ClusterGraph graph, file.graph(surface, bounds));
class ClusterFile {
  public:
    // Errors: those of Container; damage, and counts that no graph has.
    static Result<ClusterFile> open(const std::string& path);
    // The clusters of the grid of that number in a file.
    static Result<ClusterFile> open(std::shared_ptr<const Container> container, std::uint32_t grid);

    [[nodiscard]] const std::string& path() const { return container_->path(); }
    [[nodiscard]] const ClusterOutline& outline() const { return outline_; }
    // The size that the graph has in a file of its own.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

    // All groups' numbers, without first_member, held against each other, the levels, the header and the
    // file.
    [[nodiscard]] Result<std::vector<ClusterGroup>> groups() const;
    // One's, by itself; number: below outline().groups.
    [[nodiscard]] Result<ClusterGroup> group(std::uint32_t number) const;
    // All of a group. Members are below what it made, its clusters' users on the next level.
    Result<void> part(std::uint32_t number, GroupPart& part) const;
    // The whole graph, as it was written, to the bit. Over what it was built over: leaves and places come
    // from there. All is checked (core/cluster_file/sound_graph.h).
    [[nodiscard]] Result<ClusterGraph> graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                             int threads = 1) const;
    // Reads all, and says the same against a file as graph() does, without having the graph in memory: 12
    // bytes a cluster and 80 a group. leaves: those of the surface.
    Result<void> check(const OriginalSurface& surface, const GroundBounds& bounds,
                       const LeavesOneByOne& leaves, int threads = 1) const;

    // That a group is no part of a graph. what: in words that follow "group N".
    [[nodiscard]] Error unsound(std::uint32_t number, const std::string& what) const;

  private:
    ClusterFile(std::shared_ptr<const Container> container, ClusterOutline outline);
    [[nodiscard]] std::uint64_t record_offset(std::uint32_t number) const;
    [[nodiscard]] std::uint32_t level_of(std::uint32_t number) const;
    // As groups() and part(), of a file that nobody writes into.
    [[nodiscard]] Result<std::vector<ClusterGroup>> read_groups() const;
    Result<void> read_part(std::uint32_t number, GroupPart& part) const;
    [[nodiscard]] Result<void> check_chunks() const;
    // graph: without its counts, which are those of the outline.
    [[nodiscard]] Result<void> check_sound(GraphByGroups graph, const OriginalSurface& surface,
                                           const GroundBounds& bounds, int threads) const;

    std::shared_ptr<const Container> container_;
    ClusterOutline outline_;
    Chunk graph_, groups_, meshes_;
    std::uint64_t bytes_{};
    std::vector<std::uint32_t> last_groups_;  // one after the last, by level
};

}  // namespace oro
