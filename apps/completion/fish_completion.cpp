#include "apps/completion/completion.h"

namespace oro {
namespace {

constexpr const char* fish_functions = R"(# Whether the command, the first word, is one of these.
function __orograph_command
    set -l words (commandline -opc)
    test (count $words) -gt 1; and contains -- $words[2] $argv
end
function __orograph_no_command
    test (count (commandline -opc)) -eq 1
end
# Folders, and files whose names end so; every file where there is none such.
function __orograph_files
    set -l all (complete -C "__fish_command_without_completions "(commandline -ct))
    set -l fit (string match -ri -- '^.*\.(?:'(string join '|' $argv)')$' $all)
    set -q fit[1]; or set fit $all
    string match -r -- '^.*/$' $all
    printf '%s\n' $fit
end
complete -c orograph -f
complete -c orograph -n __orograph_no_command -s h -l help -d 'Print the help'
complete -c orograph -n __orograph_no_command -l version -d 'Print the version'
)";

// Text within single quotes.
std::string fish_quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + "'";
}

// " -x -a 'on off'": the words that `complete` takes for a value.
std::string fish_value(const CompletedValue& value) {
    std::string choices = spaced(value.words);
    if (value.has_files && value.endings.empty()) return " -r -F";
    if (value.has_files)
        choices +=
            (choices.empty() ? "" : " ") + std::string("(__orograph_files ") + spaced(value.endings) + ")";
    else if (value.has_folders)
        choices += "(__fish_complete_directories (commandline -ct))";
    return choices.empty() ? " -x" : " -x -k -a " + fish_quoted(choices);
}

// " -s q -l quiet"
std::string fish_names(const DescribedOption& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    return names;
}

}  // namespace

std::string fish_completion(const CompletionTexts& texts) {
    std::string script =
        std::string("# fish completion of orograph; `orograph completion fish` prints it.\n") +
        fish_functions;
    for (const DescribedCommand& command : texts.commands)
        script += "complete -c orograph -n __orograph_no_command -a " + command.name + " -d " +
                  fish_quoted(command.summary) + "\n";
    for (const DescribedCommand& command : texts.commands) {
        const std::string begin = "complete -c orograph -n '__orograph_command " + command.name + "'";
        for (const DescribedOption& option : named_options(command)) {
            const std::string value =
                option.takes_value ? fish_value(completed_value(command, option, texts.styles)) : "";
            script += begin + fish_names(option) + value + " -d " +
                      fish_quoted(first_sentence(option.sentence)) + "\n";
        }
        for (const DescribedOption& argument : positional_arguments(command)) {
            const CompletedValue value = completed_value(command, argument, texts.styles);
            if (value.has_files || !value.words.empty()) script += begin + fish_value(value) + "\n";
        }
    }
    return script;
}

}  // namespace oro
