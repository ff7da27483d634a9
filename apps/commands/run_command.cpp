#include "apps/commands/run_command.h"

#include <CLI/CLI.hpp>

#include "apps/commands/commands.h"
#include "apps/commands/coordinates.h"
#include "apps/commands/fetching.h"
#include "apps/commands/named_places.h"
#include "core/base/files_read.h"

namespace oro {
namespace {

// Of a command that only prints: it has failed where what it read was changed meanwhile. Those that write
// files have looked before these got their names.
Result<void> of_unchanged_files(const Result<void>& result) {
    return result.ok() ? check_files_unchanged() : result;
}

std::string joined_words(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (&word == words.data() ? "" : " ") + word;
    return all;
}

}  // namespace

Result<void> run_command(CLI::App& app, CommandLine& line, const std::vector<std::string>& words) {
    ORO_CHECK(take_coordinates(line));
    ORO_CHECK(take_named_places(line));
    ORO_CHECK(take_fetching(app, line));
    if (app.got_subcommand("shot")) return run_shot(line.shot);
    if (app.got_subcommand("panorama")) return run_panorama(line.panorama);
    if (app.got_subcommand("film")) return run_film(line.film);
    if (app.got_subcommand("compare")) return run_compare(line.compare);
    if (app.got_subcommand("view")) return run_view(line.view);
    if (app.got_subcommand("plan")) return of_unchanged_files(run_plan(line.plan));
    if (app.got_subcommand("trade")) {
        line.trade.command = joined_words(words);
        return run_trade(line.trade);
    }
    if (app.got_subcommand("sun")) return of_unchanged_files(run_sun(line.sun));
    if (app.got_subcommand("sight")) return of_unchanged_files(run_sight(line.sight, line.realisations));
    if (app.got_subcommand("profile")) return run_profile(line.profile);
    if (app.got_subcommand("viewshed")) return run_viewshed(line.viewshed, line.realisations, line.observers);
    if (app.got_subcommand("horizon")) return run_horizon(line.horizon);
    if (app.got_subcommand("bake")) return run_bake(line.bake);
    if (app.got_subcommand("export")) return run_export(line.exporting);
    if (app.got_subcommand("batch")) return run_batch(line.batch);
    if (app.got_subcommand("serve")) return run_serve(line.serve);
    if (app.got_subcommand("info")) return of_unchanged_files(run_info(line.info));
    if (app.got_subcommand("fetch")) return run_fetch(line.fetch);
    if (app.got_subcommand("completion")) return run_completion(app, line.completion);
    if (app.got_subcommand("manual")) return run_manual(app, line.manual);
    return run_doctor(line.doctor);
}

}  // namespace oro
