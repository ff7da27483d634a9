// How deep and long JSON may be: told from the text alone.
#include "core/base/json_bounds.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

TEST(JsonBounds, NestingIsCountedOutsideOfStrings) {
    const JsonBounds three{3, 100, 1000};
    EXPECT_FALSE(beyond_json_bounds(R"({"a":[[1],[2],{"b":3}]})", three));
    EXPECT_TRUE(beyond_json_bounds(R"({"a":[[{"b":3}]]})", three));
    EXPECT_FALSE(beyond_json_bounds(R"({"[[[[[[":"]{{{{\"[[[["})", three));
    EXPECT_FALSE(beyond_json_bounds("\"[[[[[[[[[[", three)) << "a string without an end";
    EXPECT_FALSE(beyond_json_bounds("\"\\", three)) << "nor has this";
    EXPECT_NE(beyond_json_bounds(std::string(100'000, '['))->find("nested deeper than 16 at byte 16"),
              std::string::npos);
}

TEST(JsonBounds, ValuesAndBytesAreCounted) {
    EXPECT_FALSE(beyond_json_bounds("[1,2,3]", {3, 4, 7}));
    EXPECT_TRUE(beyond_json_bounds("[1,2,3,4]", {3, 4, 100}));
    EXPECT_TRUE(beyond_json_bounds("[1,2,3]", {3, 4, 6}));
}

}  // namespace
}  // namespace oro
