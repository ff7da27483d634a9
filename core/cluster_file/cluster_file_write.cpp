#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <numeric>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/file_target.h"
#include "core/base/parallel.h"
#include "core/cluster_file/cluster_format.h"

namespace oro {
namespace {

using namespace cluster_format;

ClusterOutline outline_of(const ClusterGraph& graph, const PostCounts& posts, std::uint64_t fingerprint) {
    ClusterOutline outline;
    outline.fingerprint = fingerprint;
    outline.posts = posts;
    outline.clusters = static_cast<std::uint32_t>(graph.clusters.size());
    outline.groups = static_cast<std::uint32_t>(graph.groups.size());
    outline.members = graph.members.size();
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by == no_group)
            ++outline.leaves;
        else
            outline.triangles += cluster.triangles;
    }
    outline.levels = graph.levels;
    return outline;
}

// Keeps other writers out for as long as it is open. What a broken-off one left behind is begun anew; what
// anybody else has under that name stays.
Result<OpenFile> begin_partial(const std::string& path) {
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::write));
    if (flock(file.descriptor(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return fault(path, "is being written by another program");
    ORO_TRY(const FileBeginning begins, file_beginning(file));
    if (begins == FileBeginning::foreign)
        return fault(path, "is there already, and holds something else; move it away");
    ORO_CHECK(file.resize(0));
    return file;
}

// Codes and writes all groups, and puts sizes and checksums of both chunks into the table.
Result<void> write_groups(OpenFile& file, const GiveGroup& give, const ClusterOutline& outline,
                          Chunk& groups_in, Chunk& meshes_in, int threads) {
    RunningChecksum sum_of_records, sum_of_payloads;
    std::uint64_t end = 0;
    for (std::uint32_t first = 0; first < outline.groups; first += groups_at_a_time) {
        const std::uint32_t count = std::min(groups_at_a_time, outline.groups - first);
        std::vector<Result<std::vector<std::byte>>> coded(count, std::vector<std::byte>());
        std::vector<StoredGroup> groups(count);
        in_parallel(static_cast<int>(count), threads, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            GroupPart part;
            if (const Result<void> given = give(first + static_cast<std::uint32_t>(i), part); !given.ok()) {
                coded[at] = given.error();
                return;
            }
            coded[at] = encode_group(part, outline.posts, outline.clusters);
            groups[at].group = part.group;
            groups[at].triangles = static_cast<std::uint32_t>(part.triangles.size());
        });
        std::vector<std::byte> records, payloads;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!coded[i].ok()) return coded[i].error();
            const std::vector<std::byte>& payload = *coded[i];
            StoredGroup& stored = groups[i];
            stored.payload_offset = end + payloads.size();
            stored.payload_bytes = static_cast<std::uint32_t>(payload.size());
            stored.payload_checksum = xxh64(payload, first + i);
            const std::vector<std::byte> record = record_to_bytes(stored, first + i);
            records.insert(records.end(), record.begin(), record.end());
            payloads.insert(payloads.end(), payload.begin(), payload.end());
        }
        ORO_CHECK(file.write(meshes_in.offset + end, payloads));
        ORO_CHECK(file.write(groups_in.offset + std::uint64_t{first} * record_bytes, records));
        sum_of_records.add(records);
        sum_of_payloads.add(payloads);
        end += payloads.size();
    }
    groups_in.checksum = sum_of_records.sum();
    meshes_in.checksum = sum_of_payloads.sum();
    meshes_in.bytes = end;
    return {};
}

}  // namespace

Result<void> write_cluster_graph(const std::string& path, const ClusterGraph& graph, const PostCounts& posts,
                                 std::uint64_t fingerprint, bool overwrite, int threads) {
    const GiveGroup give = [&](std::uint32_t number, GroupPart& part) -> Result<void> {
        part = part_of(graph, number);
        return {};
    };
    return write_cluster_groups(path, outline_of(graph, posts, fingerprint), give, overwrite, threads);
}

Result<void> write_cluster_groups(const std::string& path, const ClusterOutline& outline,
                                  const GiveGroup& part, bool overwrite, int threads) {
    std::string target = path;
    ORO_TRY(const unsigned old_mode, check_target(target, overwrite));
    ignore_size_limit_signal();
    ORO_TRY(OpenFile file, begin_partial(target + ".partial"));
    const std::vector<std::byte> graph = outline_to_bytes(outline);
    ChunkTable table{0,
                     {{ChunkType::graph, 0, 0, graph.size(), xxh64(graph)},
                      {ChunkType::groups, 0, 0, std::uint64_t{outline.groups} * record_bytes, 0},
                      {ChunkType::meshes, 0, 0, 0, 0}}};
    table.place();
    ORO_CHECK(file.write(0, table.to_bytes()));
    ORO_CHECK(file.write(table.chunks[0].offset, graph));
    ORO_CHECK(write_groups(file, part, outline, table.chunks[1], table.chunks[2], threads));
    table.file_bytes = table.place();
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode != 0) (void)fchmod(file.descriptor(), old_mode);
    ORO_CHECK(file.sync());
    ORO_CHECK(file.write(0, table.to_bytes()));
    ORO_CHECK(file.sync());
    return give_name(file.path(), target, overwrite);
}

}  // namespace oro
