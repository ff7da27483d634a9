// Text from outside on one line: what a terminal would obey, or show nothing of, is seen.
#include "core/base/one_line.h"

#include <gtest/gtest.h>

#include <string>

namespace oro {
namespace {

TEST(OneLine, KeepsWhatPeopleRead) {
    for (const std::string text : {"N46E008.hgt", "Größe – 100 °", "Eiger 3’967 m", "富士山", "Гора Эльбрус",
                                   "جبل", "ལྷོ་རྩེ", "🏔", "葛\U000E0100城"})
        EXPECT_EQ(one_line(text), text);
}

TEST(OneLine, ShowsAQuestionMarkForEachUnseenCharacter) {
    for (const std::string unseen :
         {"\x01",   "\n",     "\x1b",   "\x7f",   "\u0080", "\u0085",     "\u009b",
          "\u009f", "\u00ad", "\u061c", "\u200b", "\u200c", "\u200d",     "\u200e",
          "\u200f", "\u2028", "\u2029", "\u202a", "\u202e", "\u2060",     "\u2066",
          "\u2069", "\u3164", "\ufeff", "\ufff9", "\uffff", "\U000E0041", "\U0001FFFE"})
        EXPECT_EQ(one_line("a" + unseen + "b"), "a?b") << testing::PrintToString(unseen);
    EXPECT_EQ(one_line(std::string("a\0b", 3)), "a?b");
}

TEST(OneLine, ReplacesBytesThatAreNoUtf8) {
    const std::string r = "\xEF\xBF\xBD";
    EXPECT_EQ(one_line("Z\xfcrich"), "Z" + r + "rich");      // Latin-1
    EXPECT_EQ(one_line("\xc0\xaf"), r + r);                  // an overlong '/'
    EXPECT_EQ(one_line("\xed\xa0\x80"), r + r + r);          // a surrogate
    EXPECT_EQ(one_line("\xf4\x90\x80\x80"), r + r + r + r);  // past 10FFFF
    EXPECT_EQ(one_line("a\xe2\x82"), "a" + r);               // cut off
    EXPECT_EQ(one_line("\xe2\x82(\x9b"), r + "(" + r);       // the lone C1 byte of a Latin-1 CSI
}

TEST(OneLine, CutsBetweenLetters) {
    EXPECT_EQ(one_line(std::string(1000, 'a')), std::string(1000, 'a'));
    EXPECT_EQ(one_line(std::string(1001, 'a')), std::string(1000, 'a') + "...");
    EXPECT_EQ(one_line(std::string(999, 'a') + "é"), std::string(999, 'a') + "...");
}

// Persian "می‌خواهم" and Hindi "क्‍ष" are written with joiners; "a" and "b" are not.
TEST(OneLine, KeepsJoinersInDrawnWords) {
    const std::string persian = "می\u200cخواهم", hindi = "क्\u200dष";
    EXPECT_EQ(one_line(persian, Joiners::kept_in_words), persian);
    EXPECT_EQ(one_line(hindi, Joiners::kept_in_words), hindi);
    EXPECT_EQ(one_line("a\u200cb", Joiners::kept_in_words), "a?b");
    EXPECT_EQ(one_line("می\u200c", Joiners::kept_in_words), "می?");
    EXPECT_EQ(one_line("می\u202eخ", Joiners::kept_in_words), "می?خ");
}

TEST(OneLine, JsonHasEscapesForTheUnseen) {
    EXPECT_EQ(with_unseen_escaped("{\"a\": \"é\u009b\u202e\u2028\x7f\"}"),
              "{\"a\": \"é\\u009b\\u202e\\u2028\\u007f\"}");
    EXPECT_EQ(with_unseen_escaped("\"\U000E0041\""), "\"\\udb40\\udc41\"");  // RFC 8259, section 7
    EXPECT_EQ(with_unseen_escaped("{\n  \"a\": 1\n}"), "{\n  \"a\": 1\n}");
}

}  // namespace
}  // namespace oro
