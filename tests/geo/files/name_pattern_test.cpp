// Patterns of file names: what each sign stands for.
#include "geo/files/name_pattern.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

TEST(NamePattern, SignsStandForWhatTheyShould) {
    EXPECT_TRUE(matches_name("abc", "abc"));
    EXPECT_FALSE(matches_name("abc", "abcd"));
    EXPECT_FALSE(matches_name("abc", "ab"));
    EXPECT_TRUE(matches_name("?##?###_dem", "n47e011_dem"));
    EXPECT_FALSE(matches_name("?##?###_dem", "nx7e011_dem"));
    EXPECT_TRUE(matches_name("*_am?", "tdm1_am2"));
    EXPECT_TRUE(matches_name("a*b*c", "axxbyybzc")) << "goes back to an earlier b";
    EXPECT_FALSE(matches_name("a*b*c", "axxcyy"));
    EXPECT_TRUE(matches_name("*", ""));
    EXPECT_TRUE(matches_name("one|t*o|three", "two"));
    EXPECT_FALSE(matches_name("one|two", "one|two"));
    EXPECT_FALSE(matches_name("", "")) << "no pattern matches nothing";
}

}  // namespace
}  // namespace oro
