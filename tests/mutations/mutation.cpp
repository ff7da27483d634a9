#include "tests/mutations/mutation.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <sstream>

#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;
namespace {

constexpr unsigned longest_s = 60;
constexpr rlim_t memory_bytes = rlim_t{4} << 30;

std::size_t below(std::mt19937_64& random, std::size_t count) {
    return count == 0 ? 0 : static_cast<std::size_t>(random() % count);
}

// Mostly near the front, where headers are.
std::size_t place_in(const std::string& bytes, std::mt19937_64& random) {
    const std::size_t within = random() % 2 == 0 ? std::min<std::size_t>(bytes.size(), 512) : bytes.size();
    return below(random, within);
}

void put_number(std::string& bytes, std::mt19937_64& random) {
    static constexpr std::uint64_t numbers[] = {0,
                                                1,
                                                0x7f,
                                                0x80,
                                                0xff,
                                                0x7fff,
                                                0x8000,
                                                0xffff,
                                                0x7fffffff,
                                                0x80000000,
                                                0xffffffff,
                                                0x7fffffffffffffff,
                                                0xffffffffffffffff};
    std::uint64_t number = numbers[below(random, std::size(numbers))];
    const std::size_t size = std::size_t{1} << below(random, 4), at = place_in(bytes, random);
    if (random() % 2 == 0) number = __builtin_bswap64(number) >> (64 - 8 * size);
    for (std::size_t i = 0; i < size && at + i < bytes.size(); ++i)
        bytes[at + i] = static_cast<char>(number >> (8 * i));
}

struct Shared {
    Found found;
    char said[600];
};

void become_reader(const std::function<Found(std::string& said)>& read, Shared& shared) {
    const int nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0) (void)dup2(nothing, 2);
    const rlimit memory{memory_bytes, memory_bytes}, core{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &core);
    alarm(longest_s);
    std::string said;
    try {
        shared.found = read(said);
    } catch (const std::exception& error) {
        shared.found = Found::unclean;
        said = std::string("threw ") + error.what();
    }
    if (shared.found == Found::refused && (said.empty() || std::any_of(said.begin(), said.end(), [](char c) {
                                               return static_cast<unsigned char>(c) < 0x20;
                                           })))
        shared.found = Found::unclean;
    std::strncpy(shared.said, said.c_str(), sizeof shared.said - 1);
    _exit(0);
}

}  // namespace

Mutation mutate(std::string& bytes, std::mt19937_64& random) {
    const std::size_t at = place_in(bytes, random);
    const std::size_t length = std::min(bytes.size() - at, 1 + below(random, 64));
    switch (random() % 10) {
        case 0:
        case 1:
            if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
            return {"bit at " + std::to_string(at)};
        case 2:
            if (!bytes.empty()) bytes[at] = static_cast<char>(random());
            return {"byte at " + std::to_string(at)};
        case 3:
            put_number(bytes, random);
            return {"number"};
        case 4:
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
            return {"zeros at " + std::to_string(at)};
        case 5:
            bytes.resize(below(random, bytes.size()));
            return {"cut to " + std::to_string(bytes.size()), true};
        case 6:
            bytes.erase(at, length);
            return {"taken out at " + std::to_string(at)};
        case 7:
            bytes.insert(at, bytes.substr(at, length));
            return {"doubled at " + std::to_string(at)};
        case 8: {
            const std::string piece = bytes.substr(below(random, bytes.size()), length);
            bytes.replace(at, piece.size(), piece);
            return {"moved to " + std::to_string(at)};
        }
        default:
            for (std::size_t i = 0, count = 1 + below(random, 16); i < count && !bytes.empty(); ++i)
                bytes[place_in(bytes, random)] = static_cast<char>(random());
            return {"bytes"};
    }
}

Verdict judge(const std::function<Found(std::string& said)>& read) {
    static auto* const shared = static_cast<Shared*>(
        mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    std::memset(shared, 0, sizeof *shared);
    shared->found = Found::unclean;
    const pid_t child = fork();
    if (child == 0) become_reader(read, *shared);
    int status = 0;
    waitpid(child, &status, 0);
    Verdict verdict{shared->found, WIFSIGNALED(status), WIFSIGNALED(status) ? WTERMSIG(status) : 0, false,
                    shared->said};
    verdict.hung = verdict.by_signal && verdict.signal == SIGALRM;
    return verdict;
}

// How a case ended, in words for the table, and whether it may end so.
struct End {
    std::string how;
    bool is_wrong{};
};
static End end_of(const Verdict& verdict, bool must_tell) {
    if (verdict.hung) return {"hangs", true};
    if (verdict.by_signal) return {"signal " + std::to_string(verdict.signal), true};
    switch (verdict.found) {
        case Found::unclean:
            return {"unclean", true};
        case Found::other:
            if (must_tell) return {"silently other terrain", true};
            return {"as the file says", false};
        case Found::same:
            return {"same terrain", false};
        case Found::noted:
            return {"told in a note", false};
        case Found::refused:
            return {"refused", false};
    }
    return {"?", true};
}

void expect_no_silence(const Sample& sample, long cases,
                       const std::function<Found(const fs::path& file, std::string& said)>& read) {
    const fs::path folder = scratch_folder(), kept = fs::path(KEPT_FOLDER);
    for (const auto& entry : fs::directory_iterator(sample.folder))
        fs::copy(entry.path(), folder / entry.path().filename(), fs::copy_options::recursive);
    const Verdict whole = judge([&](std::string& said) { return read(folder / sample.opened, said); });
    if (whole.found == Found::refused) {
        std::printf("%s: not opened even undamaged (%s)\n", sample.name.c_str(), whole.said.c_str());
        return;
    }
    ASSERT_EQ(static_cast<int>(whole.found), static_cast<int>(Found::same))
        << sample.name << ": " << whole.said;
    std::map<std::string, long> ends;
    int failures = 0;
    for (long number = 0; number < cases; ++number) {
        std::seed_seq seeds{seed(), static_cast<std::uint64_t>(std::hash<std::string>{}(sample.name)),
                            static_cast<std::uint64_t>(number)};
        std::mt19937_64 random(seeds);
        const std::string& name = sample.damaged[static_cast<std::size_t>(number) % sample.damaged.size()];
        const std::string before = bytes_of(sample.folder / name);
        std::string bytes = before;
        Mutation mutation = mutate(bytes, random);
        write_bytes(folder / name, bytes);
        const Verdict verdict = judge([&](std::string& said) { return read(folder / sample.opened, said); });
        const bool must_tell = sample.has_checksum || mutation.cut;
        const End end = end_of(verdict, must_tell);
        ++ends[end.how];
        if (end.is_wrong) {
            fs::create_directories(kept);
            const fs::path copy = kept / (sample.name + "-" + std::to_string(seed()) + "-" +
                                          std::to_string(number) + "-" + name);
            write_bytes(copy, bytes);
            if (++failures <= 20)
                ADD_FAILURE() << sample.name << ", seed " << seed() << ", case " << number << " ("
                              << mutation.what << ", " << name << "): " << end.how << ": " << verdict.said
                              << "\n  kept as " << copy;
        }
        write_bytes(folder / name, before);
    }
    std::printf("%s, seed %llu: %ld cases", sample.name.c_str(), static_cast<unsigned long long>(seed()),
                cases);
    for (const auto& [how, count] : ends) std::printf(", %s %ld", how.c_str(), count);
    std::printf("\n");
    std::fflush(stdout);
}

long share_of(long cases) {
    const char* const asked = std::getenv("OROGRAPH_MUTATIONS");
    const double share = asked ? std::strtod(asked, nullptr) : 0.02;
    return std::max(3L, static_cast<long>(static_cast<double>(cases) * share));
}

std::uint64_t seed() {
    const char* const asked = std::getenv("OROGRAPH_SEED");
    return asked ? std::strtoull(asked, nullptr, 10) : 1;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

void write_bytes(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace oro::test
