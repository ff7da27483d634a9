// Where the program's own data lie: beside it, at ../share/orograph, in a build tree as in an installation.
#pragma once

#include <filesystem>

namespace oro {

// The data folder; OROGRAPH_DATA overrides. Not checked for existence.
std::filesystem::path data_folder();
// From now on the data folder is this one, unless OROGRAPH_DATA overrides: for a library, which does not lie
// beside the program that runs. To be called before any thread asks for the folder.
void set_data_folder(std::filesystem::path folder);

}  // namespace oro
