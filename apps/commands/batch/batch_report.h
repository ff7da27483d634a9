// What batch found out of each line, and tells in the end.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/finished_jobs.h"
#include "apps/options/batch_options.h"
#include "apps/options/shard.h"
#include "core/base/result.h"

namespace oro {

// What became of a line.
enum class LineState { done, kept, failed, to_do };

struct LineReport {
    std::size_t line{};  // of the file, from 1
    std::string place;   // for which it was done; "": none
    std::string command;
    LineState state{LineState::to_do};
    std::vector<WrittenByJob> written;
    std::string printed;  // on standard output, where the summary holds it
    std::optional<Error> error;
    double seconds{};
};

struct BatchReport {
    Shard shard;
    std::size_t lines_of_list{};
    std::vector<LineReport> lines;  // of the shard
    std::size_t regions_read{};
    double seconds{};

    [[nodiscard]] std::size_t count(LineState state) const;
};

// A time as people say it, rounded: "40 s", "3 min", "2 h 10 min".
std::string duration_words(double seconds);
// For a person on standard error; with --json one object on standard output. Where it was only looked at the
// list, on standard output in either way.
void tell_batch(const BatchOptions& options, const BatchReport& report);

}  // namespace oro
