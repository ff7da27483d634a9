// Files that a file of a mesh names: those beside it or below its folder, and no others.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace oro {

// The path that a uri names, from the folder that all files lie in: "tiles/3/1.glb". folder: of the file that
// names it, likewise, with a slash behind it; "": that folder itself. What %.. stand for is put in their
// place; a query (?...) is left out. Nothing where the uri is on the network, absolute, empty, or leads above
// that folder.
std::optional<std::string> path_beside(std::string_view folder, std::string_view uri);

// "tiles/3/" of "tiles/3/1.glb"; "" where there is no slash.
std::string_view folder_of_path(std::string_view path);

}  // namespace oro
