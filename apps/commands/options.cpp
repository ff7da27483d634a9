#include "apps/commands/options.h"

#include <CLI/CLI.hpp>
#include <type_traits>
#include <utility>
#include <variant>

#include "apps/command_line/help.h"
#include "apps/command_line/option_group.h"
#include "apps/options/region_option_table.h"
#include "apps/view/view_option_table.h"

namespace oro {
namespace {

// Adds one option of a table.
template <class Options>
void add_row(CLI::App& command, const OptionRow<Options>& row, Options& options) {
    OptionGroup group(command, row.heading);
    const auto add = [&](auto* value) -> CLI::Option& {
        using Value = std::remove_pointer_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>)
            return group.flag(row.name, *value, row.sentence);
        else if constexpr (std::is_same_v<Value, std::optional<double>>)
            return group.number(row.name, *value, row.value_word, row.sentence);
        else if constexpr (std::is_same_v<Value, std::optional<int>>)
            return group.whole_number(row.name, *value, static_cast<int>(row.text.limits.low),
                                      static_cast<int>(row.text.limits.high), row.value_word, row.sentence);
        else if (row.words.empty())
            return group.option(row.name, *value, row.value_word, row.sentence);
        else
            return *group.choice(row.name, *value, row.words, row.sentence).option_text(row.value_word);
    };
    CLI::Option& added = *std::visit([&](auto* value) { return &add(value); }, row.target(options));
    // What follows the value of an option is elevation data.
    if (added.nonpositional()) added.allow_extra_args(false);
    if (*row.text.not_with != '\0') added.excludes(command.get_option(row.text.not_with));
    if (!row.text.is(shown_first)) list_later(command, {row.name});
}

}  // namespace

void add_region_options(CLI::App& command, RegionOptions& options) {
    for (const auto& row : region_option_table()) add_row(command, row, options);
}

void add_view_options(CLI::App& command, ViewOptions& options) {
    for (const ViewOption& row : view_option_table()) add_row<ViewOptions>(command, row, options);
}

void add_memory_options(CLI::App& command, MemoryOptions& options) {
    for (const auto& row : memory_option_table()) add_row(command, row, options);
}

void add_some_view_options(CLI::App& command, ViewOptions& options,
                           std::initializer_list<const char*> names) {
    for (const char* const name : names)
        add_row<ViewOptions>(command, row_named(view_option_table(), name), options);
}

void add_film_view_options(CLI::App& command, ViewOptions& options) {
    for (const ViewOption& row : view_option_table())
        if (!is_of_eye(row) || row.name == "--fov") add_row<ViewOptions>(command, row, options);
    const ViewOption& fov = row_named(view_option_table(), "--fov");
    OptionText text = fov.text;
    text.usual = "45";
    command.get_option("--fov")->description(sentence_of(fov.help, text));
}

void add_air_options(CLI::App& command, ViewOptions& options) {
    add_some_view_options(command, options, {"--refraction", "--air"});
    describe_standard_air(command);
}

void describe_standard_air(CLI::App& command) {
    for (const auto& [name, usual] :
         {std::pair{"--air", "standard, where --refraction is not given"}, {"--refraction", ""}}) {
        const ViewOption& row = row_named(view_option_table(), name);
        OptionText text = row.text;
        text.usual = usual;
        command.get_option(name)->description(sentence_of(row.help, text));
    }
}

void hide_region_options(CLI::App& command) {
    for (const auto& row : region_option_table())
        if (row.name != "PATH") hide(command, {row.name});
}

void hide_looks(CLI::App& command) {
    for (const ViewOption& row : view_option_table())
        if (is_look(row)) hide(command, {row.name});
}

void add_json(CLI::App& command, bool& json) {
    OptionGroup(command, "Messages")
        .flag("--json", json, "Print the results as one JSON object on standard output.");
}

void add_quiet(CLI::App& command, bool& quiet, const std::string& but) {
    OptionGroup(command, "Messages").flag("-q,--quiet", quiet, "Print nothing but " + but + ".");
}

void add_names_of_places(CLI::App& command, const std::string& heading, std::vector<std::string>& names,
                         const std::string& example) {
    OptionGroup(command, heading)
        .option("--names", names, "FILE",
                "Let names of this file stand for places, as in " + example +
                    ": the points of GPX, KML, GeoJSON, GeoPackage, a shapefile or a table (CSV), or a dump "
                    "of GeoNames. May be given several times.")
        .allow_extra_args(false);
}

void add_time(CLI::App& command, const std::string& heading, ViewOptions& options) {
    OptionGroup(command, heading)
        .option("--time", options.time, "TIME",
                "The time that is written down, e.g. 2026-11-21T09:00:00Z (default: now). It does not move "
                "the sun: --sun-time does.");
}

void add_no_paths(CLI::App& command, const std::string& heading, bool& no_paths) {
    OptionGroup(command, heading)
        .flag("--no-paths", no_paths,
              "Keep the paths of data and style out of pictures. To draw one again with --view, name the "
              "data, too.");
}

void add_unseen_ceiling(CLI::App& command, const std::string& heading, std::optional<double>& ceiling_m) {
    OptionGroup(command, heading)
        .number("--unseen-ceiling", ceiling_m, "METRES",
                "How high ground could be where there are no data, above sea level, " +
                    span(view_limits::unseen_ceiling_m) +
                    " (default 9000). A note tells how far such ground could change the picture.");
}

void add_data_changed(CLI::App& command, bool& data_changed) {
    OptionGroup(command, "The picture")
        .flag("--data-changed", data_changed,
              "Go on although the data or the geoid are others than those that the picture was drawn from.");
}

}  // namespace oro
