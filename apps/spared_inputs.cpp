#include "apps/spared_inputs.h"

#include <filesystem>

namespace oro {

Result<void> spare_inputs(const std::vector<std::string>& written, const View& view, const Region& region) {
    std::vector<std::string> inputs{view.style};
    for (const std::string& path : view.region.paths) inputs.push_back(path);
    for (const SourceReport& source : region.sources) inputs.push_back(source.path);
    for (const std::string& file : written) {
        for (const std::string& input : inputs) {
            std::error_code not_there;
            if (std::filesystem::equivalent(file, input, not_there))
                return Error{ErrorKind::usage, "--out",
                             "would replace " + input + ", which the picture is made from"};
        }
    }
    return {};
}

}  // namespace oro
