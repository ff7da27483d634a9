#include "apps/commands/fetching.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/command_line/help.h"
#include "apps/command_line/option_group.h"
#include "apps/command_line/refusals.h"
#include "apps/fetch/missing_tiles.h"
#include "apps/report/figures.h"
#include "core/base/file_there.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

constexpr double most_fetch_km = 500.0;
constexpr const char* commands_of_places[] = {"shot", "panorama", "view",     "plan",    "sun",   "sight",
                                              "film", "profile",  "viewshed", "horizon", "export"};
constexpr const char* commands_of_paths[] = {"bake", "info", "trade"};

constexpr const char* network_words =
    "Let PATHs and files to write lie on a network, by GDAL's names: /vsicurl/https://..., /vsis3/... "
    "Without "
    "this no file that is read reaches a network.";

void add_network(CLI::App& command, FetchingOptions& options) {
    OptionGroup(command, "Elevation data").flag("--network", options.network, network_words);
    list_later(command, {"--network"});
}

std::vector<AskedPlace> asked_in(const ViewOptions& view) {
    std::vector<AskedPlace> places;
    if (view.at) places.push_back({"--at", *view.at});
    if (view.look_at) places.push_back({"--look-at", *view.look_at});
    return places;
}

// Of a list of places with ; between them; none of a file.
Result<std::vector<AskedPlace>> places_along(const std::string& along) {
    std::vector<AskedPlace> places;
    ORO_TRY(const bool is_file, is_there(along));
    if (is_file || along.find(';') == std::string::npos) return places;
    for (std::size_t begin = 0; begin <= along.size();) {
        const std::size_t end = std::min(along.find(';', begin), along.size());
        places.push_back({"--along", along.substr(begin, end - begin)});
        begin = end + 1;
    }
    return places;
}

// A command's region and the places that it is about.
struct Asked {
    RegionOptions* region{};
    std::vector<AskedPlace> places;
    bool quiet{};
};

Result<Asked> asked_of(const CLI::App& app, CommandLine& line) {
    const auto is = [&](const char* command) { return app.got_subcommand(command); };
    const auto of_view = [](auto& options) {
        return Asked{&options.region, asked_in(options.view), options.quiet};
    };
    if (is("shot")) return of_view(line.shot);
    if (is("panorama")) return of_view(line.panorama);
    if (is("view")) return of_view(line.view);
    if (is("plan")) return of_view(line.plan);
    if (is("sun")) return of_view(line.sun);
    if (is("sight"))
        return Asked{
            &line.sight.region, {{"--from", line.sight.from}, {"--to", line.sight.to}}, line.sight.quiet};
    if (is("profile")) {
        ORO_TRY(std::vector<AskedPlace> places, places_along(line.profile.along));
        return Asked{&line.profile.region, std::move(places), line.profile.quiet};
    }
    if (is("viewshed")) {
        Asked asked{&line.viewshed.region, {}, line.viewshed.quiet};
        for (const std::string& at : line.viewshed.at) asked.places.push_back({"--at", at});
        return asked;
    }
    if (is("film")) return Asked{&line.film.region, {}, line.film.quiet};
    if (is("horizon")) {
        Asked asked{&line.horizon.region, {}, line.horizon.quiet};
        if (!line.horizon.at.empty()) asked.places.push_back({"--at", line.horizon.at});
        return asked;
    }
    return Asked{&line.exporting.region, {}, line.exporting.quiet};
}

}  // namespace

void add_fetching(CLI::App& app, FetchingOptions& options) {
    for (const char* const name : commands_of_places) {
        CLI::App& command = *app.get_subcommand(name);
        OptionGroup data(command, "Elevation data");
        data.option("--fetch", options.source, "SOURCE",
                    "Get what PATHs lack around the place, or of --bbox or --tile, from a public server: "
                    "skadi, glo30, glo90, terrarium, or another of `orograph fetch`. It is kept in your "
                    "cache. PATHs may be left out.");
        data.number("--fetch-km", options.km, "KM",
                    "How far around the places --fetch gets data (default 30). A panorama sees farther.");
        list_later(command, {"--fetch-km"});
        // It is the way to a first panorama.
        if (std::string_view(name) != "panorama") list_later(command, {"--fetch"});
        add_network(command, options);
    }
    for (const char* const name : commands_of_paths) add_network(*app.get_subcommand(name), options);
    OptionGroup(*app.get_subcommand("batch"), "The list").flag("--network", options.network, network_words);
}

Result<void> take_fetching(CLI::App& app, CommandLine& line) {
    tell_how_to_allow_network_paths("--network lets it be reached");
    if (line.fetching.network) allow_network_paths();
    if (line.fetching.source.empty()) return {};
    if (!(line.fetching.km > 0.0 && line.fetching.km <= most_fetch_km))
        return refused("--fetch-km", figure(line.fetching.km), "must be more than 0 and at most 500");
    ORO_TRY(const Asked asked, asked_of(app, line));
    return fetch_missing_tiles(*asked.region, asked.places, line.fetching, asked.quiet);
}

}  // namespace oro
