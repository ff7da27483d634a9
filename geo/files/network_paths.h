// Paths of GDAL's file systems that lie on a network: refused, unless the user lets them be read and written.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace oro {

// Whether a path is one of /vsicurl/, /vsis3/, /vsigs/, /vsiaz/, /vsiadls/, /vsioss/, /vsiswift/,
// /vsiwebhdfs/ or /vsihdfs/, or of their streaming twins.
bool is_network_path(std::string_view path);
// Whether GDAL writes files of that system at all: /vsicurl/ and the streaming twins are for reading alone.
bool is_network_path_for_writing(std::string_view path);

// From now on such paths are read and written, by whatever names them: a file of this machine (a VRT) may
// name them, too. Once, before start_gdal() is called for the first time, and before any thread is started.
void allow_network_paths();
bool are_network_paths_allowed();

// What refusals add for the user of a program that has a way to allow it: "--network lets it be read". Before
// any thread is started.
void tell_how_to_allow_network_paths(const std::string& words);
// The error (usage) of a path that lies on a network while such paths are not allowed.
Error network_path_refused(const std::string& path);

// For a local output, such as a folder: that its path does not lie on a network. Error: usage.
Result<void> check_on_this_machine(const std::string& path);

// What GDAL shall know of this process's environment to reach a network: who the user is to the servers
// (AWS_..., GS_..., AZURE_..., OSS_..., SWIFT_...), which servers, how long to wait, which proxy. As name and
// value. Where nothing says who the user is, only what is public is asked for, without a signature.
std::vector<std::pair<std::string, std::string>> network_options_of_environment();
// Text of GDAL's or a server's, with the keys of this process's environment left out.
std::string without_keys(std::string text);

}  // namespace oro
