// Tables of land cover: which one codes are of, and what texels count.
#include "geo/cover/cover_table.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

CoverTable table_with(const std::string& name, const std::vector<int>& codes) {
    CoverTable table{name, name, {0}, {}};
    for (const int code : codes)
        table.classes.push_back(
            {.codes = {code}, .name = "class " + std::to_string(code), .materials = {Material::meadow}});
    return table;
}

// Tens, tens and ones, and numbers in a row, as products have them.
const std::vector<CoverTable> tables{
    table_with("tens", {10, 20, 30, 40, 50}),
    table_with("many", {10, 11, 12, 20, 30, 40, 50, 60, 61, 62, 70, 80, 90, 100}),
    table_with("few", {1, 2, 3})};

std::string chosen(const std::set<int>& codes) {
    const Result<std::size_t> number = table_of_codes(tables, codes);
    return number.ok() ? tables[*number].name : number.error().what;
}

TEST(CoverTables, AreRecognisedByCodes) {
    EXPECT_EQ(chosen({0, 11, 20, 30}), "many") << "11 is of no other";
    EXPECT_EQ(chosen({0, 10, 20, 30, 40}), "tens") << "most of its classes, few of the other's";
    EXPECT_EQ(chosen({1}), "few");
}

TEST(CoverTables, OfCodesThatFitSeveralOrNoneIsAskedFor) {
    EXPECT_EQ(chosen({10, 20}),
              "its codes (10, 20) fit several tables: name its table after a comma: tens and many");
    EXPECT_EQ(chosen({1, 10}),
              "its codes (1, 10) are those of no table: name its table after a comma: tens, many, few or a "
              "table of your own");
    EXPECT_EQ(chosen({}),
              "it holds no code: name its table after a comma: tens, many, few or a table of "
              "your own");
    EXPECT_EQ(codes_words({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}), "1, 2, 3, 4, 5, 6, 7, 8 and 2 more");
}

TEST(CoverTables, ClassesOfOneColourAndMaterialAreOneGround) {
    CoverTable table = table_with("a", {1, 2, 3});
    table.classes[2].colour = {1, 2, 3};
    EXPECT_EQ(grounds_of(table).size(), 2U);
    EXPECT_EQ(table.class_of(3)->colour[2], 3);
    EXPECT_EQ(table.class_of(4), nullptr);
    EXPECT_TRUE(table.is_none(0));
}

}  // namespace
}  // namespace oro
