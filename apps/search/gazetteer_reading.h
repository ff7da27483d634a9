// Gazetteers, read in the background.
#pragma once

#include <future>
#include <stop_token>
#include <string>
#include <vector>

#include "apps/search/name_table.h"
#include "core/base/result.h"

namespace oro {

// The names of several files together.
struct GazetteerNames {
    NameTable names;
    std::vector<std::string> notes;  // of the files that were read, one line each
    std::vector<Error> errors;       // of those that could not be read
};

class GazetteerReading {
  public:
    // Begins to read the files (read_gazetteer()). Where no thread is to be had, wait() reads.
    explicit GazetteerReading(std::vector<std::string> files);
    // Gives up what is not read.
    ~GazetteerReading();
    GazetteerReading(const GazetteerReading&) = delete;
    GazetteerReading& operator=(const GazetteerReading&) = delete;

    [[nodiscard]] bool ready() const;
    // The names, once: waits for them.
    GazetteerNames wait();

  private:
    std::stop_source stop_;
    std::future<GazetteerNames> names_;
};

}  // namespace oro
