// Paths of GDAL's file systems that lie on a network: refused, unless the user lets them be read.
#pragma once

#include <string>
#include <string_view>

namespace oro {

// Whether a path is one of /vsicurl/, /vsis3/, /vsigs/, /vsiaz/, /vsiadls/, /vsioss/ or /vsiswift/, or of
// their streaming twins.
bool is_network_path(std::string_view path);

// From now on such paths are read, by whatever names them: a file of this machine (a VRT) may name them, too.
// Once, before start_gdal() is called for the first time, and before any thread is started.
void allow_network_paths();
bool are_network_paths_allowed();

}  // namespace oro
