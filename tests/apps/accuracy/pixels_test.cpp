// compare reads the picture's pixels: they must be those that its view draws.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/png_edit.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::with_pixels;
using oro::test::Words;
using oro::test::write_bytes;

class ComparedPixels : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path picture = folder / "p.png", edited = folder / "q.png";

    Outcome shoot(const fs::path& out, const Words& more = {}) const {
        Words words{"shot",      oro::test::bundled_data() / "jacksboro.tif",
                    "--out",     out,
                    "--at",      "36.6,-84.2",
                    "--above",   "300",
                    "--heading", "200",
                    "--pitch",   "-5",
                    "--size",    "320x180",
                    "-q"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
    void draw() const {
        const Outcome drawn = shoot(picture);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    void edit(const Pixels& pixels) const { write_bytes(edited, with_pixels(bytes_of(picture), pixels)); }
    // The same file as one of before there were fingerprints: then a device may have drawn otherwise.
    void forget_fingerprints() const {
        const std::string view = oro::test::view_in(edited);
        write_bytes(edited, oro::test::with_tags(bytes_of(edited),
                                                 oro::test::part_of(view, ",\"fingerprints\"", "\"}}"), "}"));
    }
    void expect_refused(const std::string& which) const {
        expect_refusal(run_orograph({"compare", edited, "-q"}), 1,
                       {"q.png: its pixels are not what its view draws", which});
        forget_fingerprints();
        expect_refusal(run_orograph({"compare", edited, "-q"}), 1,
                       {"q.png: its pixels are not what its view draws"});
    }
};

// Found: an all-red PNG with the picture's tags passed.
TEST_F(ComparedPixels, AnAllRedPictureIsRefused) {
    draw();
    Pixels red = pixels_of(picture);
    for (std::size_t i = 0; i < red.rgb.size(); ++i) red.rgb[i] = i % 3 == 0 ? 255 : 0;
    edit(red);
    expect_refused("57,600 of 57,600 pixels (columns 0 to 319, rows 0 to 179)");
}

TEST_F(ComparedPixels, AnEditedSquareIsFound) {
    draw();
    Pixels square = pixels_of(picture);
    for (std::size_t y = 90; y < 110; ++y) {
        for (std::size_t x = 203; x < 223; ++x) square.rgb[3 * (320 * y + x) + 1] ^= 0x40;
    }
    edit(square);
    expect_refused("400 of 57,600 pixels (columns 203 to 222, rows 90 to 109) differ");
}

// One pixel by one of 255, where the device draws the very pixels again.
TEST_F(ComparedPixels, ASinglePixelIsFound) {
    draw();
    Pixels one = pixels_of(picture);
    one.rgb[3 * (320 * 7 + 9)] ^= 1;
    edit(one);
    expect_refusal(run_orograph({"compare", edited, "-q"}), 1,
                   {"1 of 57,600 pixels (columns 9 to 9, rows 7 to 7) differ"});
}

TEST_F(ComparedPixels, AShiftByAPixelIsFound) {
    draw();
    const Pixels was = pixels_of(picture);
    Pixels shifted = was;
    for (std::size_t y = 0; y < 180; ++y) {
        for (std::size_t i = 3; i < 960; ++i) shifted.rgb[960 * y + i] = was.rgb[960 * y + i - 3];
    }
    edit(shifted);
    expect_refused("they were changed after it was drawn");
}

TEST_F(ComparedPixels, TheSamePixelsWrittenAnewPass) {
    draw();
    edit(pixels_of(picture));
    ASSERT_FALSE(bytes_of(edited) == bytes_of(picture));
    const Outcome outcome = run_orograph({"compare", edited, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("Pixels: as the view draws them here.\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out).at("pixels").at("differ"), 0);
}

TEST_F(ComparedPixels, OtherFormatsPass) {
    for (const char* name : {"p.jpg", "p.tif"}) {
        SCOPED_TRACE(name);
        ASSERT_EQ(shoot(folder / name).exit_code, 0);
        const Outcome outcome = run_orograph({"compare", folder / name, "--json"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const json pixels = json::parse(outcome.out).at("pixels");
        EXPECT_EQ(pixels.at("lossy"), std::string(name) == "p.jpg");
        EXPECT_EQ(pixels.at("differ"), 0) << "the same loss is done to what is drawn";
        EXPECT_EQ(run_orograph({"shot", "--view", folder / name, "-q"}).exit_code, 0);
    }
}

// The tags of one JPEG before the pixels of another, which was lit from elsewhere.
TEST_F(ComparedPixels, AnotherPicturesPixelsInAJpegAreRefused) {
    ASSERT_EQ(shoot(folder / "p.jpg").exit_code, 0);
    ASSERT_EQ(shoot(folder / "r.jpg", {"--sun", "90,20"}).exit_code, 0);
    const std::string tags = bytes_of(folder / "p.jpg"), pixels = bytes_of(folder / "r.jpg");
    const std::string tables = "\xFF\xDB";
    write_bytes(folder / "q.jpg", tags.substr(0, tags.find(tables)) + pixels.substr(pixels.find(tables)));
    expect_refusal(run_orograph({"compare", folder / "q.jpg", "-q"}), 1,
                   {"q.jpg: its pixels are not what its view draws", "they were changed after it was drawn"});
}

TEST_F(ComparedPixels, AnotherSizeOrAHalfFileIsRefused) {
    draw();
    Pixels half = pixels_of(picture);
    half.height = 90;
    std::vector<oro::test::PngChunk> chunks = oro::test::chunks_of(with_pixels(bytes_of(picture), half));
    chunks[0].data[7] = 90;  // IHDR: width and height, four bytes each
    write_bytes(edited, oro::test::png_of(chunks));
    expect_refusal(run_orograph({"compare", edited, "-q"}), 1,
                   {"q.png: has 320x90 pixels, and its view 320x180"});
    const std::string bytes = bytes_of(picture);
    write_bytes(edited, bytes.substr(0, bytes.size() / 2));
    expect_refusal(run_orograph({"compare", edited, "-q"}), 1, {"q.png", "PNG: "});
}

// What another device may change: the golden pictures, which another build drew. They are within the slack of
// 3 of 255 that the test of golden pictures has, too.
TEST_F(ComparedPixels, GoldenPicturesPass) {
    const fs::path goldens = oro::test::bundled_data() / ".." / "tests" / "goldens";
    oro::test::Circumstances in_data;
    in_data.folder = oro::test::bundled_data();
    for (const char* name :
         {"edge", "from_space", "nadir", "overview", "overview_samples", "levels_valley"}) {
        SCOPED_TRACE(name);
        const Outcome outcome =
            run_orograph({"compare", goldens / (std::string(name) + ".png"), "--json", "-q"}, in_data);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_LE(json::parse(outcome.out).at("pixels").at("largest_of_255").get<int>(), 3);
    }
}

// And the other way of drawing, as if it were another device.
TEST_F(ComparedPixels, TheOtherWayOfDrawingPasses) {
    for (const auto& [drawn, other] : {std::pair{"mesh", "auto"}, std::pair{"compute", "mesh"}}) {
        const fs::path file = folder / (std::string(drawn) + ".png");
        ASSERT_EQ(shoot(file, {"--pipeline", drawn, "--roll", "20"}).exit_code, 0);
        write_bytes(edited, oro::test::with_tags(bytes_of(file), std::string("\"pipeline\":\"") + drawn,
                                                 std::string("\"pipeline\":\"") + other));
        const Outcome outcome = run_orograph({"compare", edited, "--json", "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const json pixels = json::parse(outcome.out).at("pixels");
        EXPECT_LE(pixels.at("differ_beyond_slack").get<int>(), 57) << "a thousandth of the picture";
        EXPECT_LE(pixels.at("most_in_a_square").get<int>(), 8);
    }
}

// A style file that was edited meanwhile is not taken for edited pixels.
TEST_F(ComparedPixels, AnotherStyleIsNamed) {
    const fs::path style = folder / "mine.json";
    std::string text = bytes_of(oro::test::bundled_data() / "styles" / "haze.json");
    write_bytes(style, text);
    ASSERT_EQ(shoot(picture, {"--style", style}).exit_code, 0);
    const std::size_t ambient = text.find("\"ambient\": 0.");
    ASSERT_NE(ambient, std::string::npos) << text;
    text.replace(ambient, 14, "\"ambient\": 0.9");
    write_bytes(style, text);
    expect_refusal(run_orograph({"compare", picture, "-q"}), 1, {"its pixels are not", "style", "mine.json"});
}

}  // namespace
