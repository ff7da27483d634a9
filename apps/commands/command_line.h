// The commands and options that the program takes.
#pragma once

#include "apps/commands/options.h"
#include "apps/options/bake_part_options.h"
#include "apps/options/batch_options.h"
#include "apps/options/export_options.h"
#include "apps/options/fetch_options.h"
#include "apps/options/fetching_options.h"
#include "apps/options/horizon_options.h"
#include "apps/options/observers_options.h"
#include "apps/options/realisation_options.h"
#include "apps/options/serve_options.h"

namespace oro {

// What was given to each command; that of one command is filled in.
struct CommandLine {
    ShotOptions shot;
    PanoramaOptions panorama;
    FilmOptions film;
    WindowOptions view;
    CompareOptions compare;
    PlanOptions plan;
    TradeOptions trade;
    SunOptions sun;
    SightOptions sight;
    ProfileOptions profile;
    ViewshedOptions viewshed;
    ObserversOptions observers;  // of viewshed
    RealisationOptions realisations;  // of sight and viewshed
    HorizonOptions horizon;
    BakePartOptions bake;
    ExportOptions exporting;
    BatchOptions batch;
    ServeOptions serve;
    InfoOptions info;
    FetchOptions fetch;
    FetchingOptions fetching;  // of the commands that take it
    DoctorOptions doctor;
    CompletionOptions completion;
    ManualOptions manual;
};

// Adds the commands with their options and help. `line` must stay where it is while `app` is used.
void add_commands(CLI::App& app, CommandLine& line);

}  // namespace oro
