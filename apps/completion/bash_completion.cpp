#include <map>

#include "apps/completion/completion.h"

namespace oro {
namespace {

constexpr const char* bash_functions = R"(# Words that begin as the one that is typed does.
_orograph_words() {
  local IFS=$' \t\n'
  COMPREPLY+=($(compgen -W "$*" -- "$word"))
}
# Folders, and files whose names end so; every file where there is none such.
_orograph_files() {
  local IFS=$'\n' name ending found=
  compopt -o filenames 2>/dev/null
  COMPREPLY+=($(compgen -d -- "$word"))
  for name in $(compgen -f -- "$word"); do
    for ending in "$@"; do
      if [[ ! -d $name && ${name,,} == *".$ending" ]]; then
        COMPREPLY+=("$name")
        found=yes
      fi
    done
  done
  if [[ -z $found ]]; then COMPREPLY+=($(compgen -f -- "$word")); fi
}
_orograph_folders() {
  local IFS=$'\n'
  compopt -o filenames 2>/dev/null
  COMPREPLY+=($(compgen -d -- "$word"))
}
_orograph() {
  local command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  # --style=relief is three words here.
  if [[ $word == "=" ]]; then
    word=
  elif [[ $before == "=" ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
)";

// The call that completes a value; ":" does nothing.
std::string bash_action(const CompletedValue& value) {
    std::string calls;
    if (!value.words.empty()) calls += "_orograph_words " + spaced(value.words) + "; ";
    if (value.has_files)
        calls += "_orograph_files " + spaced(value.endings) + "; ";
    else if (value.has_folders)
        calls += "_orograph_folders; ";
    return calls.empty() ? ":" : calls.substr(0, calls.size() - 2);
}

// Branches of a case statement: "a|b) call ;;". Those with the same call are one.
class BashCase {
  public:
    void add(const std::string& pattern, const std::string& call) {
        std::string& all = patterns_[call];
        if (all.empty()) order_.push_back(call);
        all += (all.empty() ? "" : "|") + pattern;
    }
    [[nodiscard]] std::string text(const std::string& after) const {
        std::string branches;
        for (const std::string& call : order_)
            branches += "    " + patterns_.at(call) + ")\n      " + call + after + " ;;\n";
        return branches;
    }

  private:
    std::map<std::string, std::string> patterns_;
    std::vector<std::string> order_;
};

}  // namespace

std::string bash_completion(const CompletionTexts& texts) {
    BashCase values, words;
    std::vector<std::string> commands;
    for (const DescribedCommand& command : texts.commands) {
        commands.push_back(command.name);
        std::vector<std::string> names;
        for (const DescribedOption& option : named_options(command)) {
            names.insert(names.end(), option.names.begin(), option.names.end());
            if (!option.takes_value) continue;
            const std::string call = bash_action(completed_value(command, option, texts.styles));
            for (const std::string& name : option.names) values.add(command.name + ":" + name, call);
        }
        const std::string options = "_orograph_words " + spaced(names);
        words.add(command.name + ":-*", options);
        std::string arguments;
        for (const DescribedOption& argument : positional_arguments(command)) {
            const std::string call = bash_action(completed_value(command, argument, texts.styles));
            if (call != ":" && arguments.find(call) == std::string::npos)
                arguments += (arguments.empty() ? "" : "; ") + call;
        }
        words.add(command.name + ":*", arguments.empty() ? options : arguments);
    }
    values.add("*:--help|*:-h", "_orograph_words all");
    return std::string("# bash completion of orograph; `orograph completion bash` prints it.\n") +
           bash_functions + "  if ((COMP_CWORD == 1)); then\n    _orograph_words " + spaced(commands) +
           " --help --version\n    return\n  fi\n  case $command:$before in\n" + values.text("; return") +
           "  esac\n  case $command:$word in\n" + words.text("") +
           "  esac\n}\ncomplete -F _orograph orograph\n";
}

}  // namespace oro
