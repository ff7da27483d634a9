// The options that several commands have, as the command line takes them.
#pragma once

#include <optional>
#include <string>

#include "apps/options/options.h"

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

class OptionGroup;

// Options that several commands have, each under its heading in help.
void add_region_options(CLI::App& command, RegionOptions& options);
void add_view_options(CLI::App& command, ViewOptions& options);
// A place to stand at and the air around it, without a direction to look in.
void add_place_options(CLI::App& command, ViewOptions& options);
// That somebody stands on the highest post near a place. who_stands: "the eye stands"; place_option: "--at".
void add_on_summit(OptionGroup& group, bool& on_summit, const std::string& who_stands,
                   const std::string& place_option);
// Air alone, for commands without a view.
void add_air_options(CLI::App& command, AirOptions& options);
// How high ground may be where there are no data, above sea level. It decides nothing that is drawn, and so
// is no part of a view.
void add_unseen_ceiling(CLI::App& command, const std::string& heading, std::optional<double>& ceiling_m);
void add_memory_options(CLI::App& command, MemoryOptions& options);
void add_time(CLI::App& command, const std::string& heading, ViewOptions& options);
void add_no_paths(CLI::App& command, const std::string& heading, bool& no_paths);
void add_data_changed(CLI::App& command, bool& data_changed);

}  // namespace oro
