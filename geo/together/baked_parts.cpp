#include "geo/together/baked_parts.h"

#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <utility>

#include "geo/files/whole_file.h"

namespace oro {

std::string path_of_grid(const std::string& path, std::size_t number) {
    return path + ".grid-" + std::to_string(number + 1);
}

std::string path_of_clusters(const std::string& path) {
    return path + ".clusters";
}

Result<void> check_path_of_part(const std::string& part_path) {
    struct stat found {};
    if (lstat(part_path.c_str(), &found) != 0) {
        if (errno == ENOENT) return RegionFileWriter::check(part_path, true);
        return Error{ErrorKind::failed, part_path, "cannot be written: " + system_reason(errno)};
    }
    if (!S_ISREG(found.st_mode) || found.st_nlink > 1 || !looks_baked(part_path))
        return Error{ErrorKind::failed, part_path,
                     "is there already, and no bake has left it behind; move it away, or choose another name "
                     "for the region"};
    return RegionFileWriter::check(part_path, true);
}

std::optional<RegionFile> baked_grid(const std::string& grid_path, std::uint64_t fingerprint,
                                     const std::string& description) {
    Result<RegionFile> file = RegionFile::open(grid_path);
    if (!file.ok() || file->fingerprint() != fingerprint || file->outline().description != description ||
        !file->verify().ok())
        return std::nullopt;
    return std::move(*file);
}

std::optional<ClusterFile> baked_clusters(const std::string& clusters_path, std::uint64_t fingerprint) {
    Result<ClusterFile> file = ClusterFile::open(clusters_path);
    if (!file.ok() || file->outline().fingerprint != fingerprint) return std::nullopt;
    GroupPart part;
    for (std::uint32_t group = 0; group < file->outline().groups; ++group)
        if (!file->part(group, part).ok()) return std::nullopt;
    return std::move(*file);
}

Result<void> join_parts(const std::string& path, bool overwrite, std::span<const ContainerPart> parts) {
    ORO_TRY(WholeFile whole, WholeFile::create(path, overwrite));
    ORO_CHECK(join_containers(
        parts, [&](std::span<const std::byte> bytes) { return whole.write(bytes.data(), bytes.size()); }));
    const Result<void> named = whole.commit();
    // Where the name is somebody else's by now, nobody comes back for them.
    if (!named.ok() && (overwrite || access(path.c_str(), F_OK) != 0)) return named;
    for (const ContainerPart& part : parts) unlink(part.path.c_str());
    return named;
}

}  // namespace oro
