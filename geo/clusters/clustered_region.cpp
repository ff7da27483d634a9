#include "geo/clusters/clustered_region.h"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <vector>

#include "core/baked/clustered_file.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

Result<void> append(const OpenFile& file, std::uint64_t bytes, WholeFile& whole) {
    std::vector<std::byte> piece(std::size_t{1} << 20U);
    for (std::uint64_t at = 0; at < bytes; at += piece.size()) {
        const auto some = std::span(piece).first(
            static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), bytes - at)));
        ORO_CHECK(file.read(at, some));
        ORO_CHECK(whole.write(some.data(), some.size()));
    }
    return {};
}

}  // namespace

std::string path_of_clusters(const std::string& path) {
    return path + ".clusters";
}

Result<void> check_path_of_clusters(const std::string& clusters_path) {
    struct stat found {};
    if (lstat(clusters_path.c_str(), &found) != 0) {
        if (errno == ENOENT) return {};
        return Error{ErrorKind::failed, clusters_path, "cannot be written: " + system_reason(errno)};
    }
    if (!S_ISREG(found.st_mode) || found.st_nlink > 1 || !ClusterFile::open(clusters_path).ok())
        return Error{ErrorKind::failed, clusters_path,
                     "is there already, and no bake has left it behind; move it away, or choose another name "
                     "for the region"};
    return {};
}

bool are_baked_clusters(const std::string& clusters_path, std::uint64_t fingerprint) {
    const Result<ClusterFile> file = ClusterFile::open(clusters_path);
    if (!file.ok() || file->outline().fingerprint != fingerprint) return false;
    GroupPart part;
    for (std::uint32_t group = 0; group < file->outline().groups; ++group)
        if (!file->part(group, part).ok()) return false;
    return true;
}

Result<void> join_clusters(const std::string& path, const std::string& region_path,
                           const std::string& clusters_path, bool overwrite) {
    ORO_TRY(const OpenFile region, OpenFile::open(region_path, OpenFile::Use::read));
    ORO_TRY(const OpenFile clusters, OpenFile::open(clusters_path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t region_bytes, region.size());
    ORO_TRY(const std::uint64_t clusters_bytes, clusters.size());
    ORO_TRY(WholeFile whole, WholeFile::create(path, overwrite));
    const std::vector<std::byte> header = clustered_header(region_bytes, clusters_bytes);
    ORO_CHECK(whole.write(header.data(), header.size()));
    ORO_CHECK(append(region, region_bytes, whole));
    ORO_CHECK(append(clusters, clusters_bytes, whole));
    const Result<void> named = whole.commit();
    // Where the name is somebody else's by now, nobody comes back for them.
    if (!named.ok() && (overwrite || access(path.c_str(), F_OK) != 0)) return named;
    unlink(region_path.c_str());
    unlink(clusters_path.c_str());
    return named;
}

}  // namespace oro
