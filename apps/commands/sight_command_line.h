// The command lines of what asks about lines of sight and the ground along them.
#pragma once

#include "apps/commands/command_line.h"

namespace CLI {
class App;
}  // namespace CLI

namespace oro {

// Each adds its command with options and help.
void add_sight(CLI::App& app, SightOptions& options, RealisationOptions& realisations);
void add_profile(CLI::App& app, ProfileOptions& options);
void add_viewshed(CLI::App& app, ViewshedOptions& options, RealisationOptions& realisations,
                  ObserversOptions& observers);
void add_horizon(CLI::App& app, HorizonOptions& options);

}  // namespace oro
