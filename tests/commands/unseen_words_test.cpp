// The words for ground that is not loaded.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

#include "apps/accuracy/beyond_data.h"

namespace oro {
namespace {

UnseenGround beyond(int cells) {
    UnseenGround unseen;
    unseen.ceiling_m = 9000.0;
    unseen.columns = 640;
    unseen.columns_beyond = 640;
    unseen.bound_px = 311.2;
    for (int i = 0; i < cells; ++i) unseen.missing.push_back({{46, 10 + i}, 311.2 - i, 640});
    return unseen;
}

TEST(UnseenWords, OneSentenceForEachPlace) {
    EXPECT_EQ(
        unseen_sentence(beyond(1)),
        "the view reaches past the data in 640 of 640 columns (missing: N46E010): terrain there, if it is "
        "up to 9,000 m high, could rise up to 312 px above what is drawn");
    EXPECT_EQ(unseen_ending(beyond(2)),
              "In 640 of 640 columns ground beyond the data could be up to 312 px higher (missing: N46E010, "
              "N46E011).");
    UnseenGround one = beyond(1);
    one.columns = one.columns_beyond = 1;
    one.ceiling_m = -300.0;
    one.missing[0].cell = {-90, -180};
    EXPECT_EQ(unseen_sentence(one),
              "the view reaches past the data in 1 of 1 column (missing: S90W180): terrain there, if it is "
              "up to -300 "
              "m high, could rise up to 312 px above what is drawn");
}

// What is told with a picture says what helps.
TEST(UnseenWords, TheNoteSaysWhatHelps) {
    EXPECT_EQ(
        unseen_note(beyond(1)),
        "the view reaches past the data in 640 of 640 columns (missing: N46E010): ground up to 9,000 m high "
        "there could rise up to 312 px above what is drawn; give these tiles, too, or --fetch skadi gets "
        "them");
    UnseenGround whole = beyond(1);
    whole.all_in_view = true;
    EXPECT_EQ(unseen_note(whole), "");
}

TEST(UnseenWords, TwelveCellsAreNamed) {
    const std::string twelve = unseen_sentence(beyond(12)), more = unseen_sentence(beyond(14));
    EXPECT_NE(twelve.find("N46E020, N46E021):"), std::string::npos) << twelve;
    EXPECT_NE(more.find("N46E020, N46E021 and 2 more):"), std::string::npos) << more;
    EXPECT_EQ(unseen_json(beyond(14)).at("missing").size(), 14U);
}

// Found: of a part that was chosen, tiles that are there were called missing.
TEST(UnseenWords, APartThatWasChosenIsNotMissing) {
    UnseenGround part = beyond(0);
    part.columns_beyond = 0;
    part.bound_px = 0.0;
    part.columns_beyond_part = 320;
    part.part_bound_px = 99.5;
    part.beyond_part.push_back({{46, 8}, 99.5, 320});
    EXPECT_EQ(unseen_sentence(part) + unseen_ending(part), "");
    EXPECT_EQ(
        beyond_part_ending(part),
        "The part of the data that you chose ends here: in 320 of 640 columns ground beyond it could be up "
        "to 100 px higher.");
    const auto reported = unseen_json(part);
    EXPECT_EQ(reported.at("missing").size(), 0U);
    EXPECT_EQ(reported.at("chosen_part_ends").at("columns_beyond"), 320);
    EXPECT_EQ(reported.at("chosen_part_ends").at("bound_px"), 99.5);
    EXPECT_EQ(reported.at("chosen_part_ends").at("cells"), nlohmann::json::array({"N46E008"}));
    EXPECT_EQ(beyond_part_ending(beyond(1)), "");
}

// Found: a picture of all of a tile, which shows its end, said that ground could be 720 px higher.
TEST(UnseenWords, NothingIsSaidOfAPictureOfAllTheData) {
    UnseenGround all = beyond(3);
    all.all_in_view = true;
    EXPECT_EQ(unseen_sentence(all) + unseen_ending(all) + beyond_part_ending(all), "");
    EXPECT_EQ(unseen_json(all).at("all_data_in_view"), true);
    EXPECT_EQ(unseen_json(all).at("missing").size(), 3U);
}

TEST(UnseenWords, NothingIsSaidOfNothing) {
    UnseenGround none = beyond(0);
    none.columns_beyond = 0;
    EXPECT_EQ(unseen_sentence(none) + unseen_ending(none), "");
    EXPECT_EQ(unseen_json(none).at("missing").size(), 0U);
}

TEST(UnseenWords, CeilingsAreHeldToTheirLimits) {
    EXPECT_EQ(unseen_ceiling({}).value(), 9000.0);
    EXPECT_EQ(unseen_ceiling(-420.0).value(), -420.0);
    EXPECT_EQ(unseen_ceiling(100001.0).error().kind, ErrorKind::usage);
    EXPECT_EQ(unseen_ceiling(-12001.0).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace oro
