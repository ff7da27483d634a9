// Letters of many scripts, as they belong together.
#include "apps/text/shaping.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/text/font_file.h"

namespace oro {
namespace {

ShapedText shape(const std::string& text) {
    static const ShapingFont font = shaping_font(font_file, font_file_bytes);
    const auto made = shaped(font.get(), text);
    EXPECT_TRUE(made.ok());
    return *made;
}

std::vector<std::uint32_t> glyphs(const std::string& text) {
    std::vector<std::uint32_t> all;
    for (const ShapedLetter& letter : shape(text).letters) all.push_back(letter.glyph);
    return all;
}

// An accent that is a letter of its own (U+0308) stands on the one before it.
TEST(Shaping, AccentsStandOnTheirLetters) {
    EXPECT_EQ(glyphs("Sa\xCC\x88ntis"), glyphs("Säntis"));
    EXPECT_EQ(shape("Sa\xCC\x88ntis").width_em, shape("Säntis").width_em);
}

TEST(Shaping, TheFontHasLatinGreekCyrillicArabicHebrewArmenianGeorgian) {
    for (const char* name : {"Wysoka Kopa Ślęża", "Çatalkaya Ğ", "Þórisjökull", "Όλυμπος", "Эльбрус",
                             "Ђеравица", "جبل موسى", "הר מירון", "Արագած", "შხარა", "Phan Xi Păng"})
        EXPECT_TRUE(shape(name).is_whole) << name;
    for (const char* name : {"富士山", "सगरमाथा", "한라산", "ดอยอินทนนท์"})
        EXPECT_FALSE(shape(name).is_whole) << name;
}

// Arabic letters are joined: other glyphs than those of letters that stand alone, and from right to left.
TEST(Shaping, ArabicIsJoinedAndRunsLeftwards) {
    const std::string beh = "\xD8\xA8", meem = "\xD9\x85";
    const auto joined = glyphs(beh + meem), alone = glyphs(beh);
    ASSERT_EQ(joined.size(), 2U);
    EXPECT_NE(joined[1], alone[0]) << "the first letter is the one on the right";
    EXPECT_NE(joined[0], glyphs(meem)[0]);
}

// Figures in a leftward name keep their order; letters of another direction stand beyond the name.
TEST(Shaping, DirectionsFollowTheFirstOne) {
    const auto figures = glyphs("12"), mixed = glyphs("\xD7\xA8 12");  // resh
    ASSERT_EQ(mixed.size(), 4U);
    EXPECT_EQ(mixed[0], figures[0]);
    EXPECT_EQ(mixed[1], figures[1]);
    const auto latin_first = glyphs("A \xD7\xA8");
    EXPECT_EQ(latin_first.front(), glyphs("A").front());
    EXPECT_EQ(glyphs("\xD7\xA8 A").front(), glyphs("A").front());
}

TEST(Shaping, BrokenTextIsAnError) {
    const ShapingFont font = shaping_font(font_file, font_file_bytes);
    const auto broken = shaped(font.get(), "\xff");
    ASSERT_FALSE(broken.ok());
    EXPECT_NE(broken.error().line().find("UTF-8"), std::string::npos);
    EXPECT_EQ(shape("").letters.size(), 0U);
}

}  // namespace
}  // namespace oro
