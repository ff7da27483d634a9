// Times as people write them.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/light/utc_time.h"

namespace oro {
namespace {

std::int64_t seconds_of(const std::string& text) {
    const Result<std::int64_t> time = utc_time_from(text);
    EXPECT_TRUE(time.ok()) << text << (time.ok() ? "" : time.error().line());
    return time.ok() ? *time : -1;
}

TEST(UtcTime, Literals) {
    EXPECT_EQ(seconds_of("1970-01-01T00:00:00Z"), 0);
    EXPECT_EQ(seconds_of("2000-01-01T12:00Z"), 946728000);
    EXPECT_EQ(seconds_of("1900-01-01T00:00Z"), -2208988800);
    EXPECT_EQ(seconds_of("2000-02-29T23:59:59Z"), 951868799);
    EXPECT_EQ(seconds_of("0000-01-01T00:00:00Z"), -62167219200);
    EXPECT_EQ(seconds_of("9999-12-31T23:59:59Z"), 253402300799);
}

TEST(UtcTime, TheDistanceFromUtcIsTakenOff) {
    EXPECT_EQ(seconds_of("2026-06-21T05:30+02:00"), seconds_of("2026-06-21T03:30:00Z"));
    EXPECT_EQ(seconds_of("2003-10-17T12:30:30-07:00"), seconds_of("2003-10-17T19:30:30Z"));
    EXPECT_EQ(seconds_of("2026-01-01T00:15+05:45"), seconds_of("2025-12-31T18:30Z"));
    EXPECT_EQ(seconds_of("2024-02-28T23:00-01:00"), seconds_of("2024-02-29T00:00Z"));
    EXPECT_EQ(seconds_of("2026-06-21T03:30-00:00"), seconds_of("2026-06-21T03:30Z"));
}

TEST(UtcTime, WhatIsNoTimeIsRefusedAsUsage) {
    for (const char* text : {"",
                             "Z",
                             "2026",
                             "2026-06-21",
                             "2026-06-21T05:30",
                             "2026-06-21 05:30Z",
                             "2026-06-21t05:30Z",
                             "2026-6-21T05:30Z",
                             "2026-06-21T5:30Z",
                             "2026-06-21T05:30z",
                             "2026-06-21T05:30ZZ",
                             "2026-06-21T05:30:00.5Z",
                             "2026-06-21T05:30:Z",
                             "2026-06-21T05:30+02",
                             "2026-06-21T05:30+0200",
                             "2026-06-21T05:30+02:00Z",
                             "+2026-06-21T05:30Z",
                             "-026-06-21T05:30Z",
                             "2026-02-29T00:00Z",
                             "2026-13-01T00:00Z",
                             "2026-00-01T00:00Z",
                             "2026-04-31T00:00Z",
                             "2026-06-00T00:00Z",
                             "2026-06-21T24:00Z",
                             "2026-06-21T05:60Z",
                             "2016-12-31T23:59:60Z",
                             "2026-06-21T05:30+16:00",
                             "2026-06-21T05:30+02:60",
                             "0000-01-01T00:00+00:01",
                             "9999-12-31T23:59-00:01"}) {
        const Result<std::int64_t> time = utc_time_from(text);
        ASSERT_FALSE(time.ok()) << text;
        EXPECT_EQ(time.error().kind, ErrorKind::usage) << text;
        EXPECT_EQ(time.error().where, "") << text;
        EXPECT_TRUE(time.error().what.starts_with("must be a time like 2026-06-21T05:30+02:00") ||
                    time.error().what.starts_with("is ") || time.error().what.starts_with("has "))
            << text << ": " << time.error().what;
    }
}

}  // namespace
}  // namespace oro
