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
    bool has_ground{true};       // otherwise it is left out
    bool has_own_height{false};  // over the ground, in the file
};

// Which columns of the file count.
struct ObserverColumns {
    std::string above;  // whose heading it is that heights over the ground stand under; "": none
    bool is_above_everywhere{false};  // no place lacks its height
    std::vector<std::string> unused;  // headings of those that are not asked
};

struct ObserversOfFile {
    std::vector<TableObserver> all;
    ObserverColumns columns;
    std::vector<std::string> notes;  // of reading, one line each
};

// Errors (usage): --observers beside places of the command line, or places in a CRS; --table without
// --observers, or that is no .csv, or cannot be written.
Result<void> check_observers(const ObserversOptions& observers, const ViewshedOptions& options);

// The places of the file, in its order: each has `lat` and `lon` in degrees (a table's columns, by these
// names or others that mean the same; points of vector files have them by themselves), and may have `above`,
// its height over the ground in metres (above_ground_column()), in place of --above; on_summit and what
// observers stand on are those of `options`. Errors: those of read_places(); a place without `lat` and `lon`,
// with numbers that are none, or with a `height` that no mast has, which names the file and the place.
Result<ObserversOfFile> read_observers(const ObserversOptions& observers, const ViewshedOptions& options);

// Marks those that stand where there are no elevation data (has_ground). Errors: those of
// stand_over_ground(), which name the file and the place; no_data where none has ground.
Result<void> find_ground(const std::string& file, const SightGround& ground,
                         std::vector<TableObserver>& observers);
// Errors: a column that is only called height, most of whose values are the ground's own height above the sea
// where they stand: it names the file, the column and the first such place.
Result<void> check_above_ground(const std::string& file, const ObserverColumns& columns,
                                const SightGround& ground, const std::vector<TableObserver>& observers);
// Where those stand that have ground.
std::vector<Standing> standings_of(const std::vector<TableObserver>& observers);

// "9,998 of masts.csv; 2 stand where there are no elevation data and are left out, the first is place 17"
std::string observers_words(const std::string& file, const std::vector<TableObserver>& observers);
// "2 m above the ground (the table has no column above)" or "by the column Height, in metres above the
// ground"
std::string eyes_words(const ObserverColumns& columns, const ViewshedOptions& options);
// "owner and colour", as many as fit into a line; "": all columns are asked.
std::string unused_words(const ObserverColumns& columns);
// A line for each place of the file, in its order: where its eye is, how high that is over the ground, and
// how many posts it sees. One that was left out has its place alone.
std::string observers_csv(const std::vector<TableObserver>& observers, const ViewshedReport& report,
                          const SightGround& ground);

}  // namespace oro
