#include "apps/command_line/refusals.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <utility>

#include "apps/command_line/edit_distance.h"
#include "apps/command_line/help.h"

namespace oro {
namespace {

// The name of the check of choices, whose description lists them, each but the last with an end.
constexpr const char* choice_check = "choice";
constexpr const char* choice_end = "|";

// What a check of a value throws through the parser.
class RefusedValue final : public CLI::ParseError {
  public:
    explicit RefusedValue(oro::Error error)
        : CLI::ParseError(error.line(), CLI::ExitCodes::ValidationError), error_(std::move(error)) {}
    [[nodiscard]] const oro::Error& error() const { return error_; }

  private:
    oro::Error error_;
};

// With its dashes, of hidden options, too, of which the parser gives none.
std::string option_name(const CLI::Option& option) {
    return (option.nonpositional() ? option.get_lnames().empty() ? "-" : "--" : "") +
           option.get_single_name();
}

[[noreturn]] void refuse(const CLI::Option& option, const std::string& value, const std::string& what) {
    throw RefusedValue(refused(option_name(option), value, what));
}

// "a value must follow: --above METRES"
std::string missing_words(const CLI::Option& option) {
    return "a value must follow: " + option_name(option) + " " + option.get_option_text();
}

// " (orograph plan --help lists them)"
std::string see(const CLI::App& command, const std::string& what_it_does) {
    return " (orograph " + command.get_name() + " --help " + what_it_does + ")";
}

// That there is a value: not nothing, nor the name of another option where this one's value is missing.
void check_given(const CLI::App& command, const CLI::Option& option, const std::string& text) {
    if (text.empty()) refuse(option, "", "its value is empty");
    if (option.nonpositional() && text.starts_with('-') && command.get_option_no_throw(text))
        refuse(option, "", missing_words(option));
}

// How many characters of a word may differ from those of a name that it is like: one of three.
std::size_t most_changes(const std::string& word, const std::string& name) {
    const auto letters = [](const std::string& text) {
        return text.size() - std::min(text.find_first_not_of('-'), text.size());
    };
    return std::min(std::size_t{2}, std::max(letters(word), letters(name)) / 3);
}

// ": did you mean --heights?", or nothing where no name is like the word.
std::string nearest_words(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t longest_word = 40;
    if (word.size() > longest_word) return {};
    const auto changes = [&](const std::string& name) { return edit_distance(word, name); };
    const auto nearest = std::ranges::min_element(names, {}, changes);
    if (nearest == names.end() || changes(*nearest) > most_changes(word, *nearest)) return {};
    return ": did you mean " + *nearest + "?";
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    return names;
}

// Those that help names.
std::vector<std::string> listed_commands(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({}))
        if (is_listed(*command)) names.push_back(command->get_name());
    return names;
}

std::vector<std::string> listed_options(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        if (option->nonpositional() && !option->get_group().empty()) names.push_back(option_name(*option));
    }
    return names;
}

// An option or a word that stands where a command should.
Error before_command(const std::string& word) {
    const std::string name = word.substr(0, word.find('='));
    return refused(name, "", "stands before the command: orograph COMMAND " + name);
}

// What of the command line nothing takes.
Error of_left_over(const CLI::App& app) {
    const std::vector<std::string> before = app.remaining(false), all = app.remaining(true);
    const std::string word = all.empty() ? std::string() : all.front(), name = word.substr(0, word.find('='));
    const bool is_option = word.starts_with('-');
    if (!before.empty() || app.get_subcommands().empty()) return before_command(word);
    const CLI::App& command = *app.get_subcommands().front();
    if (!is_option)
        return refused(word, "",
                       command.get_name() + " takes options only, no files" + see(command, "lists them"));
    const std::string near = nearest_words(name, listed_options(command));
    return refused(
        name, "",
        command.get_name() + " has no such option" + (near.empty() ? see(command, "all lists them") : near));
}

// Of two options that exclude each other.
std::pair<std::string, std::string> excluded(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        for (const CLI::Option* other : option->get_excludes()) {
            if (option->count() > 0 && other->count() > 0) return {option_name(*option), option_name(*other)};
        }
    }
    return {};
}

// Too many values, or none.
Error of_count(const CLI::App& command, const std::vector<std::string>& words) {
    for (const CLI::Option* option : command.get_options()) {
        if (option->results().size() >
            static_cast<std::size_t>(std::max(1, option->get_items_expected_max())))
            return refused(option_name(*option), "", "is given more than once");
    }
    const CLI::Option* const last = command.get_option_no_throw(words.back());
    return refused(words.back(), "", last ? missing_words(*last) : "a value must follow");
}

Error of_no_command(const std::string& word, const std::vector<std::string>& names) {
    const std::string near = nearest_words(word, names);
    return refused("", "",
                   "there is no command \"" + word + "\"" +
                       (near.empty() ? "; these are " + joined(names, " and ") : near));
}

Error of_missing(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_required() && option->count() == 0)
            return refused(option_name(*option), "", "is missing" + see(command, "tells what it is"));
    }
    return refused("", "", "an argument is missing" + see(command, "tells more"));
}

}  // namespace

Error refused(const std::string& option, const std::string& value, const std::string& what) {
    return {ErrorKind::usage, option + (value.empty() ? "" : " " + value), what};
}

std::string joined(const std::vector<std::string>& words, const std::string& last) {
    std::string all;
    for (std::size_t i = 0; i < words.size(); ++i)
        all += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
    return all;
}

std::string choose_words(const std::vector<std::string>& choices) {
    return "choose " + joined(choices, " or ");
}

std::string between_words(double low, double high) {
    char text[80];
    std::snprintf(text, sizeof text, "must be between %.15g and %.15g", low, high);
    return text;
}

std::string either_words(const std::string& one, const std::string& other) {
    return "give either " + one + " or " + other + ", not both";
}

void need_value(const CLI::App& command, CLI::Option& option) {
    option.check([&command, &option](const std::string& text) {
        check_given(command, option, text);
        return std::string();
    });
}

void need_choice(CLI::Option& option, const std::vector<std::string>& choices) {
    const auto listed = [&option, choices](const std::string& text) {
        if (std::ranges::find(choices, text) == choices.end()) refuse(option, text, choose_words(choices));
        return std::string();
    };
    option.check(listed, CLI::detail::join(choices, choice_end), choice_check);
}

std::vector<std::string> choices_of(CLI::Option& option) {
    try {
        return CLI::detail::split(option.get_validator(choice_check)->get_description(), choice_end[0]);
    } catch (const CLI::OptionNotFound&) {
        return {};
    }
}

void need_number(CLI::Option& option) {
    option.check([&option](const std::string& text) {
        double number = 0.0;
        if (!CLI::detail::lexical_cast(text, number)) refuse(option, text, "is not a number");
        return std::string();
    });
}

void need_whole_number(const CLI::App& command, CLI::Option& option, int low, int high) {
    const auto read = [&command, &option, low, high](std::string& text) {
        check_given(command, option, text);
        const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
        if (text.size() == sign || text.find_first_not_of("0123456789", sign) != std::string::npos)
            refuse(option, text, "is not a whole number");
        const std::size_t first = std::min(text.find_first_not_of('0', sign), text.size() - 1);
        const std::string digits = (text.starts_with('-') ? "-" : "") + text.substr(first);
        int number = 0;
        const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (fault != std::errc() || number < low || number > high)
            refuse(option, text, between_words(low, high));
        text = digits;
        return std::string();
    };
    option.transform(CLI::Validator(read, ""));
}

void need_no_value(CLI::Option& option) {
    option.check([&option](const std::string& text) {
        bool is_set = false;
        if (!CLI::detail::lexical_cast(text, is_set)) refuse(option, "", "takes no value");
        return std::string();
    });
}

std::optional<Error> refusal_of_command(const CLI::App& app, const std::vector<std::string>& words) {
    const std::vector<std::string> names = command_names(app);
    constexpr std::string_view with_value = "--help=";
    bool has_command = false;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const bool is_attached = words[i].starts_with(with_value);
        const std::string word = is_attached ? words[i].substr(with_value.size()) : words[i];
        if (is_attached || is_after_help(words, i)) {
            if (word == "all" || word.empty() || word.starts_with('-')) continue;
            if (is_attached || has_command)
                return refused("", "", "--help takes nothing or all, not " + word);
        }
        if (has_command || word.starts_with('-')) continue;
        has_command = std::ranges::find(names, word) != names.end();
        if (!has_command) return of_no_command(word, listed_commands(app));
    }
    return std::nullopt;
}

Error refusal_of(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
    if (const auto* of_value = dynamic_cast<const RefusedValue*>(&error)) return of_value->error();
    const std::vector<std::string> names = command_names(app);
    if (words.size() > 1 && !words[1].starts_with('-') && std::ranges::find(names, words[1]) == names.end())
        return of_no_command(words[1], listed_commands(app));
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) return of_left_over(app);
    if (app.get_subcommands().empty()) return before_command(words.size() > 1 ? words[1] : "");
    const CLI::App& command = *app.get_subcommands().front();
    if (dynamic_cast<const CLI::RequiredError*>(&error)) return of_missing(command);
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return of_count(command, words);
    if (dynamic_cast<const CLI::ExcludesError*>(&error)) {
        const auto [one, other] = excluded(command);
        return refused(one, "", either_words(one, other));
    }
    return refused("", "", error.what() + see(command, "tells more"));
}

}  // namespace oro
