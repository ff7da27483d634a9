// Observers of a table or a vector file, many of them: who they are, where they stand, and what each sees.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/viewshed_report.h"
#include "apps/eye/standpoint.h"
#include "apps/options/observers_options.h"
#include "core/base/result.h"

namespace oro {

// One place of the file.
struct TableObserver {
    std::string words;  // for messages: "place 17 (Mast 17)"
    std::size_t number{};
    std::string name;  // "": the file has none
    Standing standing;
    bool has_ground{true};  // otherwise it is left out
};

// Errors (usage): --observers beside places of the command line, or places in a CRS; --table without
// --observers, or that is no .csv, or cannot be written.
Result<void> check_observers(const ObserversOptions& observers, const ViewshedOptions& options);

// The places of the file, in its order: each has `lat` and `lon` in degrees (a table's columns, by these
// names or others that mean the same; points of vector files have them by themselves), and may have `above`,
// its height over the ground in metres, in place of --above; on_summit and what observers stand on are those
// of `options`. Errors: those of read_places(); a place without `lat` and `lon`, or with numbers that are
// none, which names the file and the place.
Result<std::vector<TableObserver>> read_observers(const ObserversOptions& observers,
                                                  const ViewshedOptions& options);

// Marks those that stand where there are no elevation data (has_ground). Errors: those of
// stand_over_ground(), which name the file and the place; no_data where none has ground.
Result<void> find_ground(const std::string& file, const SightGround& ground,
                         std::vector<TableObserver>& observers);
// Where those stand that have ground.
std::vector<Standing> standings_of(const std::vector<TableObserver>& observers);

// "9,998 of masts.csv; 2 stand where there are no elevation data and are left out, the first is place 17"
std::string observers_words(const std::string& file, const std::vector<TableObserver>& observers);
// A line for each place of the file, in its order: where its eye is, and how many posts it sees. One that was
// left out has its place alone.
std::string observers_csv(const std::vector<TableObserver>& observers, const ViewshedReport& report,
                          const SightGround& ground);

}  // namespace oro
