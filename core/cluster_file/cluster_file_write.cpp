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
    ORO_TRY(const std::uint64_t found, file.size());
    std::array<std::byte, magic.size()> begins{};
    const auto there = std::span(begins).first(std::min<std::uint64_t>(found, begins.size()));
    ORO_CHECK(file.read(0, there));
    if (!std::equal(there.begin(), there.end(), std::as_bytes(std::span(magic)).begin()))
        return fault(path, "is there already, and holds something else; move it away");
    ORO_CHECK(file.resize(0));
    return file;
}

// Codes and writes all groups; gives where the last ends.
Result<std::uint64_t> write_groups(OpenFile& file, const GiveGroup& give, const Header& header, int threads) {
    const ClusterOutline& outline = header.outline;
    const Offsets offsets = offsets_of(header);
    std::uint64_t end = offsets.payloads;
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
            const RecordBytes record = record_to_bytes(stored, first + i);
            records.insert(records.end(), record.begin(), record.end());
            payloads.insert(payloads.end(), payload.begin(), payload.end());
        }
        ORO_CHECK(file.write(end, payloads));
        ORO_CHECK(file.write(offsets.records + std::uint64_t{first} * record_bytes, records));
        end += payloads.size();
    }
    return end;
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
    Header header{0, outline, static_cast<std::uint32_t>(outline.levels.size()),
                  xxh64(levels_to_bytes(outline.levels))};
    ORO_CHECK(file.write(0, header_to_bytes(header)));
    ORO_CHECK(file.write(header_bytes, levels_to_bytes(outline.levels)));
    ORO_TRY(header.file_bytes, write_groups(file, part, header, threads));
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode != 0) (void)fchmod(file.descriptor(), old_mode);
    ORO_CHECK(file.sync());
    ORO_CHECK(file.write(0, header_to_bytes(header)));
    ORO_CHECK(file.sync());
    const int why = take_file_name(file.path(), target, overwrite);
    if (why == EEXIST && !overwrite)
        return fault(target, "appeared while it was being written, and is left as it is; the new one is " +
                                 file.path());
    if (why != 0) return fault(target, "cannot be written: " + system_reason(why));
    return {};
}

}  // namespace oro
