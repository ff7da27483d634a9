#include "apps/commands/shot/shot_files.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "apps/command_line/refusals.h"
#include "apps/layers/picture_layers.h"
#include "apps/output/overwrite_guard.h"
#include "apps/output/pose_files.h"
#include "core/base/file_there.h"
#include "core/base/open_file.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// True when a drawn picture has the bytes of a file.
Result<bool> is_same(WholeFile& drawn, const std::string& path) {
    ORO_TRY(const OpenFile other, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(std::uint64_t left, other.size());
    std::FILE* const stream = drawn.stream();
    if (std::fseek(stream, 0, SEEK_END) != 0 || static_cast<std::uint64_t>(ftello(stream)) != left)
        return false;
    std::rewind(stream);
    std::vector<std::byte> ours(1 << 16), theirs(ours.size());
    for (std::uint64_t at = 0; left > 0;) {
        const std::size_t count = std::min<std::uint64_t>(left, ours.size());
        ORO_CHECK(other.read(at, std::span(theirs).first(count)));
        if (std::fread(ours.data(), 1, count, stream) != count ||
            !std::equal(ours.begin(), ours.begin() + static_cast<std::ptrdiff_t>(count), theirs.begin()))
            return false;
        at += count;
        left -= count;
    }
    return true;
}

}  // namespace

Result<PictureFiles> shot_files(const ShotOptions& options) {
    if (options.out.empty() && options.view_file.empty())
        return refused("--out", "", "is missing: name the picture to write (.png, .jpg or .tif)");
    std::string out = options.out.empty() ? options.view_file : options.out;
    if (options.out.empty() && fs::path(out).extension() == ".json") {
        for (const char* ending : {".png", ".jpg", ".jpeg", ".tif", ".tiff"}) {
            out = fs::path(options.view_file).replace_extension(ending).string();
            ORO_TRY(const bool there, is_there(out));
            if (there) break;
            out = fs::path(options.view_file).replace_extension(".png").string();
        }
    }
    if (const auto format = picture_format(out); !format.ok())
        return refused(options.out.empty() ? "--view" : "--out", out, format.error().what);
    return picture_files(out);
}

bool is_check(const ShotOptions& options, const PictureFiles& files) {
    std::error_code ignored;
    return options.out.empty() && !options.overwrite && fs::is_regular_file(files.picture, ignored);
}

std::vector<std::string> written_files(const ShotOptions& options, const PictureFiles& files) {
    std::vector<std::string> all;
    if (!is_check(options, files)) all.push_back(files.picture);
    if (options.verify) all.push_back(files.error);
    if (options.ortho && !is_check(options, files)) all.push_back(world_file_path(files.picture));
    for (const std::string& pose : pose_paths(files.picture, poses_asked(options))) all.push_back(pose);
    if (options.layers)
        for (const char* layer : layers_of_view(options.covers, options.has_meshes))
            all.push_back(layer_path(files.picture, layer));
    return all;
}

Result<void> check_out(const ShotOptions& options, const PictureFiles& files) {
    for (const std::string& file : written_files(options, files))
        ORO_CHECK(check_may_write(file, options.overwrite));
    return {};
}

PictureFiles unnamed(const PictureFiles& files) {
    std::error_code failed;
    const fs::path folder = fs::temp_directory_path(failed);
    PictureFiles other = files;
    other.picture =
        ((failed ? fs::path("/tmp") : folder) / ("orograph-check-" + std::to_string(getpid()))).string() +
        fs::path(files.picture).extension().string();
    return other;
}

Result<void> finish_shot(const ShotOptions& options, const PictureFiles& files, ShotResult& shot,
                         WholeFile picture, std::vector<WholeFile> companions) {
    std::vector<WholeFile*> together;
    for (WholeFile& file : companions) together.push_back(&file);
    if (!is_check(options, files)) {
        together.push_back(&picture);
        return commit_together(together);
    }
    ORO_CHECK(commit_together(together));
    ORO_TRY(shot.same_bytes, is_same(picture, files.picture));
    const std::optional<Fingerprints>& recorded = shot.view.recorded->fingerprints;
    const bool same_pixels = shot.difference && shot.difference->any.count == 0;
    if (shot.same_bytes || (same_pixels && (!recorded || recorded->program != program_fingerprint())))
        return {};
    const std::string where =
        same_pixels || !shot.difference
            ? ""
            : ": " + pixels_words(shot.difference->any, shot.difference->pixels) + " differ";
    return Error{ErrorKind::failed, files.picture,
                 "is not what its view draws now" + where +
                     "; left as it is (--overwrite replaces it, --out writes another)"};
}

}  // namespace oro
