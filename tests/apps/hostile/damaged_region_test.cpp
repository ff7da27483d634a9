// One damaged byte in a baked region, seen through each command: what is told is what the whole file tells,
// or nothing is, and one line says which byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "tests/apps/baked/baking.h"
#include "tests/support/mutated_bytes.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Bake;
using oro::test::bytes_of;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::scratch_folder;
using oro::test::Words;
using oro::test::write_bytes;

// The bundled region: 403 x 344 posts in 4 x 3 pages of level 0.
class DamagedRegion : public Bake {
  protected:
    // Where a page's payload lies: the record says so (core/base/container.h, core/baked/region_format.h).
    struct Payload {
        std::size_t offset;
        std::size_t bytes;
    };
    static constexpr std::size_t record_bytes = 444, pages = 17;
    static std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
        std::uint64_t number = 0;
        for (std::size_t i = size; i-- > 0;)
            number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
        return number;
    }
    static std::vector<Payload> payloads(const std::string& bytes) {
        std::size_t records = 0, heights = 0;
        for (std::size_t line = 32; records == 0 || heights == 0; line += 32) {
            const std::string type = bytes.substr(line, 4);
            if (type == "PAGE") records = number_at(bytes, line + 8, 8);
            if (type == "HGTS") heights = number_at(bytes, line + 8, 8);
        }
        std::vector<Payload> all;
        for (std::size_t page = 0; page < pages; ++page) {
            const std::size_t end = records + (page + 1) * record_bytes;  // offset, bytes, two checksums
            all.push_back({heights + number_at(bytes, end - 28, 8), number_at(bytes, end - 20, 4)});
        }
        EXPECT_EQ(all.back().offset + all.back().bytes, bytes.size());
        return all;
    }
    // What a shot tells and draws; of a refusal its line.
    struct Shot {
        Outcome outcome;
        std::string picture;
        std::string view;
    };
    Shot shoot(const fs::path& region, const Words& how) const {
        const fs::path out = scratch_folder();
        Shot shot{run_orograph(joined({"shot", region, "--size", "48x32", "--time", "2026-01-01T00:00:00Z",
                                       "--pipeline", "compute", "--out", out / "p.png", "-q"},
                                      how)),
                  "", ""};
        if (shot.outcome.exit_code != 0) {
            EXPECT_EQ(names_in(out), Words{}) << "left behind";
            return shot;
        }
        shot.picture = bytes_of(out / "p.png");
        shot.view = oro::test::view_in(out / "p.png");
        return shot;
    }
    // Puts other bytes in the region's place: a view names it by its path.
    static void expect_same_or_refused(const Shot& shot, const Shot& whole, const fs::path& region) {
        if (shot.outcome.exit_code != 0) return oro::test::expect_refusal(shot.outcome, 1, {region, "byte"});
        EXPECT_TRUE(shot.picture == whole.picture);
        EXPECT_EQ(shot.view, whole.view);
    }
};

TEST_F(DamagedRegion, EachPageInCoarsePictures) {
    const fs::path region = baked();
    const std::string bytes = bytes_of(region);
    // The whole region; and from a place, which asks for the ground there.
    const std::vector<Words> views{
        {"--tau", "200"}, {"--tau", "200", "--at", "36.6,-84.2", "--above", "400", "--pitch", "-40"}};
    for (const Words& view : views) {
        const Shot whole = shoot(region, view);
        ASSERT_EQ(whole.outcome.exit_code, 0) << whole.outcome.err;
        int refused = 0;
        for (const Payload& payload : payloads(bytes)) {
            SCOPED_TRACE(payload.offset);
            std::string damaged = bytes;
            damaged[payload.offset + payload.bytes / 2] ^= 1;
            write_bytes(region, damaged);
            const Shot shot = shoot(region, view);
            expect_same_or_refused(shot, whole, region);
            refused += shot.outcome.exit_code == 0 ? 0 : 1;
        }
        write_bytes(region, bytes);
        std::printf("%d of %zu pages were needed\n", refused, pages);
        // The page under the eye, or all that the eye of the whole region is placed by.
        EXPECT_GE(refused, view.size() > 2 ? 1 : 12);
    }
}

TEST_F(DamagedRegion, ThePageOfTheEye) {
    const fs::path region = baked();
    std::string bytes = bytes_of(region);
    for (const Payload& payload : payloads(bytes)) bytes[payload.offset + 5] ^= 16;
    write_bytes(region, bytes);
    // Damage is the reason, not that there were no data.
    for (const Words& view :
         {Words{}, Words{"--at", "36.6,-84.2"}, Words{"--at", "36.6,-84.2", "--altitude", "900"}})
        oro::test::expect_refusal(shoot(region, view).outcome, 1, {region, "is damaged at byte"});
    oro::test::expect_refusal(run_orograph({"plan", region, "--at", "36.6,-84.2"}), 1,
                              {region, "is damaged at byte"});
    oro::test::expect_refusal(
        run_orograph({"bake", region, "--bbox", "-84.3,36.5,-84.2,36.6", "--out", folder / "part.oro"}), 1,
        {region, "is damaged at byte"});
    EXPECT_EQ(names_in(folder), Words{"region.oro"});
}

struct Command {
    Words words;
    const char* writes;  // a file of its folder, which is compared
};
// Each command that reads a region, on this one or on a picture of it.
std::vector<Command> commands_on(const fs::path& region, const fs::path& view) {
    const std::string time = "2026-01-01T00:00:00Z";
    return {{{"info", region, "--json"}, nullptr},
            {{"info", region, "--check"}, nullptr},
            {{"shot", region, "--size", "48x32", "--tau", "0", "--time", time, "-q", "--out", "out.png"},
             "out.png"},
            {{"shot", region, "--size", "48x32", "--tau", "200", "--at", "36.6,-84.2", "--time", time, "-q",
              "--out", "out.jpg"},
             "out.jpg"},
            {{"plan", region, "--size", "48x32", "--at", "36.6,-84.2", "--above", "300", "--time", time, "-q",
              "--json"},
             nullptr},
            {{"compare", view, "-q", "--json"}, nullptr},
            {{"bake", region, "--bbox", "-84.3,36.5,-84.2,36.6", "-q", "--out", "out.oro"}, "out.oro"}};
}

struct Answer {
    Outcome outcome;
    std::string file;
};
// Runs it in a folder of its own, in which only what it writes may be left.
Answer ask(const Command& command) {
    oro::test::Circumstances there;
    there.folder = scratch_folder();
    Answer answer{run_orograph(command.words, there), ""};
    const Words left = names_in(there.folder);
    if (answer.outcome.exit_code != 0 || command.writes == nullptr) {
        EXPECT_EQ(left, Words{}) << "left behind";
    } else {
        answer.file = bytes_of(there.folder / command.writes);
    }
    return answer;
}

// Each command over a file that was changed anywhere. The long run: OROGRAPH_TEST_MUTATIONS=2500.
TEST_F(DamagedRegion, AnyMutationThroughEachCommand) {
    const fs::path region = baked();
    const std::string bytes = bytes_of(region);
    std::vector<std::size_t> parts{0, 192};  // header; outline, description and undulation
    for (std::size_t page = 0; page < pages; ++page)
        parts.push_back(payloads(bytes).front().offset - (pages - page) * record_bytes);
    for (const Payload& payload : payloads(bytes)) parts.push_back(payload.offset);
    const fs::path view = folder / "view.png";
    ASSERT_EQ(run_orograph({"shot", region, "--size", "48x32", "--out", view, "-q"}).exit_code, 0);
    const std::vector<Command> commands = commands_on(region, view);
    std::vector<Answer> whole;
    for (const Command& command : commands) {
        whole.push_back(ask(command));
        ASSERT_EQ(whole.back().outcome.exit_code, 0) << command.words[0] << ": " << whole.back().outcome.err;
    }
    const auto seed = std::random_device{}();
    const int count = oro::test::mutation_count(5);
    std::printf("seed %u, %d mutations\n", seed, count);
    std::mt19937_64 random(seed);
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        const oro::test::Mutation mutation = oro::test::mutated(bytes, parts, random);
        write_bytes(region, mutation.bytes);
        for (std::size_t c = 0; c < commands.size(); ++c) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", " + mutation.what + ", " + commands[c].words[0]);
            const Answer answer = ask(commands[c]);
            if (answer.outcome.exit_code != 0) {
                ++refused;
                oro::test::expect_refusal(answer.outcome, 1, {region});
            } else {
                EXPECT_EQ(answer.outcome.out, whole[c].outcome.out);
                EXPECT_TRUE(answer.file == whole[c].file);
            }
        }
    }
    EXPECT_GE(refused, count) << "info --check refuses each";
}

}  // namespace
