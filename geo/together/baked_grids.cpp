#include "geo/together/baked_grids.h"

#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>

#include "core/baked/grids_file.h"
#include "core/baked/region_file.h"
#include "geo/files/whole_file.h"

namespace oro {

std::string path_of_grid(const std::string& path, std::size_t number) {
    return path + ".grid-" + std::to_string(number + 1);
}

Result<void> check_path_of_grid(const std::string& grid_path) {
    struct stat found {};
    if (lstat(grid_path.c_str(), &found) != 0) {
        if (errno == ENOENT) return RegionFileWriter::check(grid_path, true);
        return Error{ErrorKind::failed, grid_path, "cannot be written: " + system_reason(errno)};
    }
    if (!S_ISREG(found.st_mode) || found.st_nlink > 1 || !looks_like_region_file(grid_path))
        return Error{ErrorKind::failed, grid_path,
                     "is there already, and no bake has left it behind; move it away, or choose another name "
                     "for the region"};
    return RegionFileWriter::check(grid_path, true);
}

bool is_baked_grid(const std::string& grid_path, std::uint64_t fingerprint, const std::string& description,
                   CellSplit split) {
    const Result<RegionFile> file = RegionFile::open(grid_path);
    return file.ok() && file->fingerprint() == fingerprint && file->outline().description == description &&
           file->outline().grid.split == split && file->verify().ok();
}

Result<void> join_grids(const std::string& path, bool overwrite, const std::vector<std::uint32_t>& ranks) {
    std::vector<OpenFile> grids;
    std::vector<std::uint64_t> sizes;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        ORO_TRY(OpenFile grid, OpenFile::open(path_of_grid(path, i), OpenFile::Use::read));
        ORO_TRY(const std::uint64_t bytes, grid.size());
        sizes.push_back(bytes);
        grids.push_back(std::move(grid));
    }
    ORO_TRY(WholeFile whole, WholeFile::create(path, overwrite));
    const std::vector<std::byte> header = grids_header(sizes, ranks);
    ORO_CHECK(whole.write(header.data(), header.size()));
    std::vector<std::byte> piece(std::size_t{1} << 20U);
    for (std::size_t i = 0; i < grids.size(); ++i) {
        for (std::uint64_t at = 0; at < sizes[i]; at += piece.size()) {
            const auto bytes = std::span(piece).first(
                static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), sizes[i] - at)));
            ORO_CHECK(grids[i].read(at, bytes));
            ORO_CHECK(whole.write(bytes.data(), bytes.size()));
        }
    }
    const Result<void> named = whole.commit();
    // Where the name is somebody else's by now, nobody comes back for them.
    if (!named.ok() && (overwrite || access(path.c_str(), F_OK) != 0)) return named;
    for (std::size_t i = 0; i < ranks.size(); ++i) unlink(path_of_grid(path, i).c_str());
    return named;
}

}  // namespace oro
