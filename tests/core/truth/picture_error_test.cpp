// Summaries of errors against literal values.
#include "core/truth/picture_error.h"

#include <gtest/gtest.h>

#include <cstdint>

#include <vector>

namespace oro {
namespace {

TEST(ErrorSummary, TakesTheNearestRankOfAbsoluteValues) {
    // 20,000 values, 1 .. 20,000 with alternating signs: 99.99 % of them are 19,998, 99 % are 19,800.
    std::vector<double> values;
    for (int i = 1; i <= 20000; ++i) values.push_back(i % 2 == 0 ? i : -i);
    const ErrorSummary summary = summary_of(values);
    EXPECT_EQ(summary.count, 20000U);
    EXPECT_EQ(summary.largest, 20000.0);
    EXPECT_EQ(summary.p9999, 19998.0);
    EXPECT_EQ(summary.p99, 19800.0);
    EXPECT_EQ(summary.mean, 10000.5);
}

TEST(ErrorSummary, OfFewIsTheLargestAndOfNoneZero) {
    const ErrorSummary two = summary_of(std::vector<double>{-3.0, 1.0});
    EXPECT_EQ(two.largest, 3.0);
    EXPECT_EQ(two.p9999, 3.0);
    EXPECT_EQ(two.p99, 3.0);
    EXPECT_EQ(two.mean, 2.0);
    const std::vector<float> unmeasured{not_measured, -2.0F, not_measured};
    EXPECT_EQ(summary_of(unmeasured).count, 1U);
    EXPECT_EQ(summary_of(unmeasured).mean, 2.0);
    const ErrorSummary none = summary_of(std::vector<double>{});
    EXPECT_EQ(none.count, 0U);
    EXPECT_EQ(none.largest + none.p9999 + none.p99 + none.mean, 0.0);
}

// 1 to 100, of which 40 and 100 are only known to be no smaller: so are the largest and the mean, and of the
// shares those from 40 on.
TEST(ErrorSummaries, SayWhichFiguresAreAtLeastThat) {
    std::vector<float> values;
    for (int i = 1; i <= 100; ++i) values.push_back(static_cast<float>(i));
    std::vector<std::uint8_t> at_least(100, 0);
    at_least[39] = at_least[99] = 1;
    const ErrorSummary summary = summary_of(values, at_least);
    EXPECT_EQ(summary.at_least, 2U);
    EXPECT_EQ(summary.least_of_these, 40.0);
    EXPECT_TRUE(summary.is_at_least(summary.largest));
    EXPECT_TRUE(summary.is_at_least(summary.p99));
    EXPECT_TRUE(summary.is_at_least(summary.mean));
    EXPECT_FALSE(summary.is_at_least(39.0));
    EXPECT_FALSE(summary_of(values).is_at_least(100.0));
    at_least[39] = 0;
    EXPECT_FALSE(summary_of(values, at_least).is_at_least(99.0))
        << "99 of 100 are no larger, whatever 100 is";
}

}  // namespace
}  // namespace oro
