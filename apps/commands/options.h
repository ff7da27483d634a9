// The options that several commands have, as the command line takes them.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "apps/options/options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

// Options that several commands have, each under its heading in help.
void add_region_options(CLI::App& command, RegionOptions& options);
void add_view_options(CLI::App& command, ViewOptions& options);
void add_memory_options(CLI::App& command, MemoryOptions& options);
// Those of a view with these names alone.
void add_some_view_options(CLI::App& command, ViewOptions& options, std::initializer_list<const char*> names);
// Those of a view whose eye is said elsewhere: all but the eye's place and direction.
void add_film_view_options(CLI::App& command, ViewOptions& options);
// Air alone, for commands without a picture: standard where nothing is given.
void add_air_options(CLI::App& command, ViewOptions& options);
// Lets help say that standard air is the default.
void describe_standard_air(CLI::App& command);
// Takes all options of the data but their paths, or all that change looks, out of a command's help.
void hide_region_options(CLI::App& command);
void hide_looks(CLI::App& command);
// How high ground may be where there are no data, above sea level. It decides nothing that is drawn, and so
// is no part of a view.
void add_unseen_ceiling(CLI::App& command, const std::string& heading, std::optional<double>& ceiling_m);
// Results as JSON, and nothing said but what `but` names.
void add_json(CLI::App& command, bool& json);
void add_quiet(CLI::App& command, bool& quiet, const std::string& but);
// Files whose names stand for places, in commands that draw no names. example: "--at Eiger".
void add_names_of_places(CLI::App& command, const std::string& heading, std::vector<std::string>& names,
                         const std::string& example);
void add_time(CLI::App& command, const std::string& heading, ViewOptions& options);
void add_no_paths(CLI::App& command, const std::string& heading, bool& no_paths);
void add_data_changed(CLI::App& command, bool& data_changed);

}  // namespace oro
