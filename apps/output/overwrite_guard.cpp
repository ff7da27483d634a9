#include "apps/output/overwrite_guard.h"

#include <filesystem>

#include "core/base/file_there.h"
#include "core/base/files_read.h"
#include "geo/files/network_files.h"
#include "geo/files/network_paths.h"
#include "geo/files/whole_file.h"

namespace oro {

namespace fs = std::filesystem;

FilesToSpare files_of_ground(const std::vector<std::string>& paths, const Region& region) {
    FilesToSpare ground{paths, "which the elevation data are in"};
    for (const RegionGrid& grid : region.grids) {
        for (const SourceReport& source : grid.sources) {
            ground.files.push_back(source.path);
            ground.files.insert(ground.files.end(), source.files.begin(), source.files.end());
        }
    }
    return ground;
}

FilesToSpare files_of_picture(const View& view, const Region& region) {
    FilesToSpare picture{files_of_ground(view.region.paths, region).files, "which the picture is made from"};
    const std::vector<std::string>& meshes = view.region.meshes.files;
    picture.files.insert(picture.files.end(), meshes.begin(), meshes.end());
    picture.files.push_back(view.style);
    picture.files.insert(picture.files.end(), view.drape.begin(), view.drape.end());
    for (const ImageSource& image : view.images)
        picture.files.insert(picture.files.end(), image.files.begin(), image.files.end());
    picture.files.insert(picture.files.end(), view.cover_choice.files.begin(), view.cover_choice.files.end());
    if (is_table_path(view.cover_choice.table)) picture.files.push_back(view.cover_choice.table);
    if (view.cover)
        for (const CoverSource& source : view.cover->sources())
            picture.files.insert(picture.files.end(), source.files.begin(), source.files.end());
    if (view.canopy)
        for (const CanopySource& source : view.canopy->sources())
            picture.files.insert(picture.files.end(), source.files.begin(), source.files.end());
    VectorChoices vectors = view.vectors;
    for (const std::string* const file : vectors.paths()) picture.files.push_back(*file);
    return picture;
}

FilesToSpare files_of_view(const std::string& view_file) {
    FilesToSpare view{{view_file, view_file + ".json"},
                      "which is the view, or the picture that it belongs to"};
    for (const char* ending : {".json", ".png", ".jpg", ".jpeg", ".tif", ".tiff"})
        view.files.push_back(fs::path(view_file).replace_extension(ending).string());
    return view;
}

namespace {

Error there_already(const std::string& file) {
    return {ErrorKind::failed, file, "is there already (--overwrite replaces it)"};
}

// With `overwrite` nobody asks a server whether it has the file.
Result<void> check_may_write_to_network(const std::string& file, bool overwrite) {
    ORO_CHECK(check_network_target(file, true));
    if (overwrite) return {};
    ORO_TRY(const std::optional<NetworkFile> there, network_file(file));
    if (there) return there_already(file);
    return {};
}

}  // namespace

Result<void> check_may_write(const std::string& file, bool overwrite) {
    if (is_network_path(file)) return check_may_write_to_network(file, overwrite);
    ORO_TRY(const bool there, is_there(file));
    std::error_code ignored;
    if (there && !overwrite && !fs::is_directory(file, ignored)) return there_already(file);
    if (const auto trial = WholeFile::create(file, overwrite); !trial.ok()) return trial.error();
    return {};
}

Result<void> spare_inputs(const std::vector<std::string>& written, const std::vector<FilesToSpare>& inputs,
                          const std::string& option) {
    for (const std::string& file : written) {
        const bool is_on_network = is_network_path(file);
        ORO_TRY(const bool there, is_there(file));
        if (!there && !is_on_network) continue;
        for (const FilesToSpare& some : inputs) {
            for (const std::string& input : some.files) {
                bool same = is_on_network && file == input;
                if (!is_on_network) {
                    ORO_TRY(same, is_same_file(file, input));
                }
                if (same)
                    return Error{ErrorKind::usage, option,
                                 "would replace " + input + ", " + some.what_they_are};
            }
        }
        if (!is_on_network) ORO_CHECK(check_not_read(file));
    }
    return {};
}

}  // namespace oro
