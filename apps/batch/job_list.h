// The list of jobs that batch does: which command each line gives, as words of a command line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/batch_places.h"
#include "core/base/result.h"

namespace oro {

// A file or a folder that a line names to be written, and the option that names it: "--out", or "print".
struct NamedOutput {
    std::string option;
    std::string file;
};

// One line of a list.
struct BatchJob {
    std::size_t line{};  // of the file, from 1
    std::string place;   // for which the line is done, as messages name it; "": none
    std::string command;
    std::vector<std::string> words;   // of the command line, without the program's name
    std::string print;                // the file that takes what the command prints; "": none
    std::vector<NamedOutput> writes;  // what the words name to be written, and `print`
    std::vector<std::string> reads;   // all other values of its options, and its PATHs: some are files
    std::string region;               // which data it opens, as far as words tell: the same of the same
    std::optional<Error> fault;       // it cannot be understood: all but `line` says nothing then
};

// A list has so many jobs and bytes at most, and a line so many bytes.
inline constexpr std::size_t most_jobs = 1'000'000;
inline constexpr std::size_t most_list_bytes = std::size_t{1} << 30;
inline constexpr std::size_t most_line_bytes = std::size_t{1} << 20;

// The jobs of a list, in its order: JSON objects, one a line. Empty lines, and those that begin with #, are
// passed over. A line that cannot be understood is a job with a fault. places: each line is then a job for
// each of them, in their order, with what the place has in place of each {field} of its texts
// (with_fields()). Errors: a file that cannot be read, is too long, is no text, or has no job that can be
// understood.
Result<std::vector<BatchJob>> read_jobs(const std::string& file, const std::vector<BatchPlace>& places = {});

// The job of one line of JSON:
//   {"command": "shot", "path": "alps", "at": [46.5, 8.0], "size": [1920, 1080], "sky": true, "out": "a.png"}
// Names are those of the command's options, with _ or - between words. A list of numbers is one value, a list
// of texts several. null and false are as if the name were not there. "path" or "paths", "flight" and
// "picture" are what stands without a name on the command line; "args" is a list of words for its end;
// "print" names a file for what the command prints. Gives a job with a fault where the line cannot be
// understood.
BatchJob job_of_line(const std::string& text, std::size_t line, const BatchPlace* place = nullptr);

}  // namespace oro
