#include "apps/command_line/described_command.h"

#include <CLI/CLI.hpp>

#include "apps/command_line/help.h"
#include "apps/command_line/refusals.h"

namespace oro {
namespace {

DescribedOption described_option(CLI::Option& option) {
    DescribedOption described;
    described.is_positional = !option.nonpositional();
    if (described.is_positional) described.names.push_back(option.get_single_name());
    for (const std::string& name : option.get_snames()) described.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) described.names.push_back("--" + name);
    described.heading = option.get_group();
    described.value_word = option.get_option_text();
    described.takes_value = !described.is_positional && !described.value_word.empty();
    described.is_repeatable = option.get_expected_max() > 1;
    described.sentence = option.get_description();
    described.choices = choices_of(option);
    return described;
}

}  // namespace

std::vector<DescribedCommand> described_commands(CLI::App& app) {
    std::vector<DescribedCommand> all;
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        DescribedCommand& described = all.emplace_back();
        described.name = command->get_name();
        described.summary = command->get_description();
        described.is_listed = is_listed(*command);
        const CommandHelp help = help_of(*command);
        described.usages = help.usages;
        described.note = help.note;
        described.page = help.page;
        for (CLI::Option* option : command->get_options())
            if (!option->get_group().empty()) described.options.push_back(described_option(*option));
    }
    return all;
}

}  // namespace oro
