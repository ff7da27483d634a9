// Where the program's own data lie: beside it, at ../share/orograph, in a build tree as in an installation.
#pragma once

#include <filesystem>

namespace oro {

// The data folder; OROGRAPH_DATA overrides. Not checked for existence.
std::filesystem::path data_folder();

}  // namespace oro
