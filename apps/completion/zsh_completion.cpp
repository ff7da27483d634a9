#include <string_view>

#include "apps/completion/completion.h"

namespace oro {
namespace {

// Text within single quotes of zsh, in which these characters have a backslash.
std::string zsh_quoted(const std::string& text, std::string_view special) {
    std::string quoted;
    for (const char c : text) {
        if (c == '\'') {
            quoted += "'\\''";
            continue;
        }
        if (c == '\\' || special.find(c) != std::string_view::npos) quoted += '\\';
        quoted += c;
    }
    return quoted;
}

std::string zsh_files(const CompletedValue& value) {
    if (value.endings.empty()) return "_files";
    return "_files -g \"*.(#i)(" + spaced(value.endings, "|") + ")(-.)\"";
}

// What follows an option's name: ":METRES:", ":on|off:(on off)".
std::string zsh_value(const CompletedValue& value, const std::string& word) {
    const std::string message = ":" + zsh_quoted(word, ":") + ":";
    if (!value.words.empty() && value.has_files) return message + "_orograph_styles";
    if (!value.words.empty()) return message + "(" + spaced(value.words) + ")";
    if (value.has_files) return message + zsh_files(value);
    return message + (value.has_folders ? "_files -/" : " ");
}

// One line of _arguments for each of an option's names.
std::string zsh_option(const DescribedCommand& command, const DescribedOption& option,
                       const std::vector<std::string>& styles) {
    const std::string about = "[" + zsh_quoted(first_sentence(option.sentence), "[]:") + "]";
    std::string lines;
    for (const std::string& name : option.names) {
        std::string line = option.is_repeatable && option.takes_value ? "*" : "";
        if (option.names.size() > 1) line = "(" + spaced(option.names) + ")";
        line += name + (option.takes_value && name.starts_with("--") ? "=" : "") + about;
        if (option.takes_value)
            line += zsh_value(completed_value(command, option, styles), option.value_word);
        lines += " \\\n        '" + line + "'";
    }
    return lines;
}

// The files of --style; its words are those of the program.
std::string zsh_styles(const CompletionTexts& texts) {
    for (const DescribedCommand& command : texts.commands) {
        for (const DescribedOption& option : command.options) {
            const CompletedValue value = completed_value(command, option, texts.styles);
            if (!value.words.empty() && value.has_files)
                return "_orograph_styles() {\n  _alternative 'styles:style:(" + spaced(value.words) +
                       ")' 'files:file:" + zsh_files(value) + "'\n}\n";
        }
    }
    return {};
}

}  // namespace

std::string zsh_completion(const CompletionTexts& texts) {
    std::string script =
        "#compdef orograph\n# zsh completion of orograph; `orograph completion zsh` prints it.\n" +
        zsh_styles(texts) + "_orograph() {\n  local -a commands=(\n";
    for (const DescribedCommand& command : texts.commands)
        script += "    '" + command.name + ":" + zsh_quoted(command.summary, ":") + "'\n";
    script +=
        "  )\n  if ((CURRENT == 2)); then\n    _describe -t commands command commands\n"
        "    _arguments '--help[Print the help]' '--version[Print the version]'\n    return\n  fi\n"
        "  local command=$words[2]\n  shift words\n  ((CURRENT--))\n  case $command in\n";
    for (const DescribedCommand& command : texts.commands) {
        script += "    " + command.name + ")\n      _arguments";
        for (const DescribedOption& option : named_options(command))
            script += zsh_option(command, option, texts.styles);
        int number = 1;
        for (const DescribedOption& argument : positional_arguments(command)) {
            const std::string place = argument.is_repeatable ? "*" : std::to_string(number++);
            script += " \\\n        '" + place +
                      zsh_value(completed_value(command, argument, texts.styles), argument.names.back()) +
                      "'";
        }
        script += "\n      ;;\n";
    }
    return script + "  esac\n}\n_orograph \"$@\"\n";
}

}  // namespace oro
