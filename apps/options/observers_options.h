// What the command line says of observers of a table: masts, turbines, lookouts.
#pragma once

#include <string>

namespace oro {

struct ObserversOptions {
    std::string file;   // a table or a vector file, of which each place is an observer; "": none
    std::string table;  // the .csv to write: what each of them sees; "": none
};

}  // namespace oro
