// Damaged input: bytes changed by a seed, and what must hold of whatever is made of them.
//
// What counts. A case fails when the process that reads it ends by a signal, takes more than 60 s, throws, or
// says something that is no single clean line. What is read without an error or a note more than of the
// undamaged file must be the terrain of the undamaged file, to the bit of every post and of the grid,
// wherever the format has a checksum
// (.oro, zip, gzip, deflated TIFF, PNG) and wherever bytes are missing (a file that was cut). In a format
// without a checksum a changed byte of a sample or of a header is what the file says: nothing can tell. Such
// cases are counted apart ("as the file says"), and nothing is asked of them but that they end in order. Of
// views and pictures: what is read must be written and read again as the same view.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace oro::test {

// What a reader in a process of its own found.
enum class Found : int { refused, same, noted, other, unclean };

struct Verdict {
    Found found{Found::unclean};
    bool by_signal{};
    int signal{};
    bool hung{};
    std::string said;
};

// What a mutation did to the bytes.
struct Mutation {
    std::string what;
    bool cut{};  // bytes are missing at the end
};

// Changes bytes in one of many ways: bits, bytes, numbers, pieces put elsewhere, taken out, doubled or
// zeroed, the end cut.
Mutation mutate(std::string& bytes, std::mt19937_64& random);

// Runs `read` in a forked process with limits on time (60 s) and memory. It sets `said` to a line of an
// error, if any.
Verdict judge(const std::function<Found(std::string& said)>& read);

// A kind of input: a folder of files, of which one is damaged at a time.
struct Sample {
    std::string name;
    std::filesystem::path folder;
    std::string opened;                // the file that is opened
    std::vector<std::string> damaged;  // one of these
    bool has_checksum{};
};

// Damages the sample `cases` times and tells each failure as a failed expectation; the damaged file is kept.
// `read` is given the path to open.
void expect_no_silence(
    const Sample& sample, long cases,
    const std::function<Found(const std::filesystem::path& file, std::string& said)>& read);

// OROGRAPH_MUTATIONS=1 runs all cases, 0.02 (the default) runs a fiftieth; at least 3.
long share_of(long cases);
// OROGRAPH_SEED, or 1.
std::uint64_t seed();

std::string bytes_of(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

}  // namespace oro::test
