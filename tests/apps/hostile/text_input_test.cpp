// Texts and pictures that are read as JSON: nested as no program of ours writes it, too long, and files that
// are none.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

// A value whose lists stand in each other.
std::string nested(std::size_t deep) {
    return std::string(deep, '[') + std::string(deep, ']');
}

std::string big_endian(std::size_t value, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 255);
    return text;
}

std::string xmp_with(const std::string& view) {
    return "<x:xmpmeta xmlns:orograph=\"urn:orograph:1.0/\"><orograph:View>" + view +
           "</orograph:View></x:xmpmeta>";
}

std::string png_with(const std::string& view) {
    const std::string chunk = std::string("iTXtXML:com.adobe.xmp\0\0\0\0\0", 26) + xmp_with(view);
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(chunk.data()), static_cast<uInt>(chunk.size()));
    return "\x89PNG\r\n\x1a\n" + big_endian(chunk.size() - 4, 4) + chunk + big_endian(sum, 4);
}

std::string jpeg_with(const std::string& view) {
    const std::string segment = std::string("http://ns.adobe.com/xap/1.0/\0", 29) + xmp_with(view);
    return "\xFF\xD8\xFF\xE1" + big_endian(segment.size() + 2, 2) + segment;
}

// Big-endian, one directory of one entry: tag 700, bytes, at byte 26.
std::string tiff_with(const std::string& view) {
    const std::string packet = xmp_with(view);
    return std::string("MM\0*\0\0\0\x08\0\1\2\xBC\0\1", 14) + big_endian(packet.size(), 4) +
           big_endian(26, 4) + std::string(4, '\0') + packet;
}

class TextInput : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path drawn = oro::test::scratch_folder();

    Outcome shoot(const Words& more, const Circumstances& circumstances = {}) const {
        Words words{"shot", bundled(), "--size", "64x48", "-q", "--out", drawn / "p.png"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words, circumstances);
    }
};

// 100,000 brackets in a view ended in a segmentation fault: JSON is told, copied and freed by recursion.
TEST_F(TextInput, NestedJsonIsRefusedWhereverItStands) {
    const auto view = [](std::size_t deep) { return "{\"orograph_view\":" + nested(deep) + "}"; };
    write_bytes(folder / "v.json", view(100'000));
    write_bytes(folder / "v.png", png_with(view(100'000)));
    write_bytes(folder / "v.jpg", jpeg_with(view(32'000)));  // a segment has no room for more
    write_bytes(folder / "v.tif", tiff_with(view(100'000)));
    for (const std::string& name : names_in(folder)) {
        SCOPED_TRACE(name);
        const fs::path file = folder / name;
        expect_refusal(run_orograph({"plan", "--view", file}), failed, {file, "nested deeper than 16"});
        expect_refusal(run_orograph({"shot", "--view", file, "--out", drawn / "p.png"}), failed, {file});
        expect_refusal(run_orograph({"compare", file}), failed, {file, "nested"});
    }
    const fs::path style = folder / "style.json";
    write_bytes(style, "{\"tints\":" + nested(100'000) + "}");
    expect_refusal(shoot({"--style", style}), failed, {style, "nested"});
    EXPECT_EQ(names_in(drawn), Words{});
}

// What doctor has measured for auto is a cache: damaged, it hinders no picture, and is measured again.
TEST_F(TextInput, NestedCacheIsWrittenAnew) {
    write_bytes(folder / "pipelines.json",
                "{\"orograph_pipelines\":1,\"measured\":[" + nested(100'000) + "]}");
    Circumstances own_cache;
    own_cache.environment = {"OROGRAPH_CACHE=" + folder.string()};
    const Outcome outcome = shoot({}, own_cache);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(run_orograph({"doctor"}, own_cache).exit_code, 0);
    EXPECT_EQ(oro::test::bytes_of(folder / "pipelines.json").find("[[["), std::string::npos);
}

// A pipe at which nobody writes was waited for without end.
TEST_F(TextInput, PipesDevicesAndEndlessFilesAreRefused) {
    for (const char* name : {"pipe.json", "pipe.png", "pipelines.json"})
        ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    fs::create_symlink("/dev/zero", folder / "zero.json");
    fs::create_symlink("/dev/zero", folder / "zero.png");
    write_bytes(folder / "huge.json", "{");
    fs::resize_file(folder / "huge.json", std::uintmax_t{1} << 40);
    write_bytes(folder / "huge.png", "\x89PNG\r\n\x1a\n");
    fs::resize_file(folder / "huge.png", std::uintmax_t{1} << 40);
    for (const char* name :
         {"pipe.json", "pipe.png", "zero.json", "zero.png", "huge.json", "huge.png", "/dev/stdin"}) {
        SCOPED_TRACE(name);
        const fs::path file = folder / name;
        const auto within_10_s = [&](Words words) {
            words.insert(words.begin(), {"timeout", "10", OROGRAPH_PROGRAM});
            expect_refusal(run_program(words), failed, {file});
        };
        within_10_s({"plan", "--view", file});
        within_10_s({"compare", file});
        within_10_s({"shot", bundled(), "--size", "64x48", "--style", file, "--out", drawn / "p.png"});
    }
    Circumstances own_cache;
    own_cache.environment = {"OROGRAPH_CACHE=" + folder.string()};
    const Outcome outcome = run_program({"timeout", "60", OROGRAPH_PROGRAM, "shot", bundled(), "--style",
                                         "default", "--size", "64x48", "-q", "--out", drawn / "p.png"},
                                        own_cache);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

}  // namespace
