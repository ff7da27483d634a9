#include "apps/fetch/fetch_progress.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

TEST(FetchProgressWords, TellTilesBytesAndTheRate) {
    EXPECT_EQ(fetch_progress_words({3, 8, 25'100'000, 12.0}), "3 of 8 tiles, 25.1 MB, 2.1 MB/s");
    EXPECT_EQ(fetch_progress_words({1, 8, 12'500'000, 0.5}), "1 of 8 tiles, 12.5 MB, 25.0 MB/s");
}

TEST(FetchProgressWords, TellNoRateOfNothing) {
    EXPECT_EQ(fetch_progress_words({8, 8, 0, 4.0}), "8 of 8 tiles, 0.0 MB");
    EXPECT_EQ(fetch_progress_words({1, 8, 3'000'000, 0.01}), "1 of 8 tiles, 3.0 MB");
}

}  // namespace
}  // namespace oro
