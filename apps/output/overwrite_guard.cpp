#include "apps/output/overwrite_guard.h"

#include <filesystem>

#include "core/base/file_there.h"

namespace oro {

namespace fs = std::filesystem;

Result<void> spare_files(const std::vector<std::string>& written, const std::vector<std::string>& inputs,
                         const std::string& what_they_are) {
    for (const std::string& file : written) {
        ORO_TRY(const bool there, is_there(file));
        if (!there) continue;
        for (const std::string& input : inputs) {
            ORO_TRY(const bool same, is_same_file(file, input));
            if (same)
                return Error{ErrorKind::usage, "--out", "would replace " + input + ", " + what_they_are};
        }
    }
    return {};
}

namespace {

void add_ground(const std::vector<std::string>& paths, const Region& region,
                std::vector<std::string>& inputs) {
    inputs.insert(inputs.end(), paths.begin(), paths.end());
    for (const SourceReport& source : region.sources) {
        inputs.push_back(source.path);
        inputs.insert(inputs.end(), source.files.begin(), source.files.end());
    }
}

}  // namespace

Result<void> spare_inputs(const std::vector<std::string>& written, const View& view, const Region& region) {
    std::vector<std::string> inputs{view.style};
    add_ground(view.region.paths, region, inputs);
    inputs.insert(inputs.end(), view.drape.begin(), view.drape.end());
    VectorChoices vectors = view.vectors;
    for (const std::string* const file : vectors.paths()) inputs.push_back(*file);
    return spare_files(written, inputs, "which the picture is made from");
}

Result<void> spare_ground(const std::vector<std::string>& written, const std::vector<std::string>& paths,
                          const Region& region) {
    std::vector<std::string> inputs;
    add_ground(paths, region, inputs);
    return spare_files(written, inputs, "which the elevation data are in");
}

Result<void> spare_view(const std::vector<std::string>& written, const std::string& view_file) {
    std::vector<std::string> inputs{view_file, view_file + ".json"};
    for (const char* ending : {".json", ".png", ".jpg", ".jpeg", ".tif", ".tiff"})
        inputs.push_back(fs::path(view_file).replace_extension(ending).string());
    return spare_files(written, inputs, "which is the view, or the picture that it belongs to");
}

}  // namespace oro
