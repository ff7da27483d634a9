// orograph completion and orograph manual: the command line itself, as shells and man(1) read it.
#include "apps/completion/completion.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "apps/command_line/manual.h"
#include "apps/commands/commands.h"
#include "apps/view/style.h"

namespace oro {

Result<void> run_completion(CLI::App& app, const CompletionOptions& options) {
    const std::string script = completion_script(options.shell, {described_commands(app), style_names()});
    std::fputs(script.c_str(), stdout);
    return {};
}

Result<void> run_manual(CLI::App& app, const ManualOptions& options) {
    const std::vector<DescribedCommand> commands = described_commands(app);
    const auto asked = std::ranges::find(commands, options.command, &DescribedCommand::name);
    const std::string page =
        asked == commands.end() ? program_manual_page(app.get_description(), commands) : manual_page(*asked);
    std::fputs(page.c_str(), stdout);
    return {};
}

}  // namespace oro
