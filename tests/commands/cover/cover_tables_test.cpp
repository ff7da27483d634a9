// The tables of land cover that come with the program, and what is wrong with others.
#include "apps/cover/cover_tables.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

namespace oro {
namespace {

std::vector<CoverTable> bundled_tables() {
    std::vector<CoverTable> tables;
    for (const std::string& name : cover_table_names()) {
        auto read = read_cover_table(name);
        EXPECT_TRUE(read.ok()) << read.error().line();
        if (read.ok()) tables.push_back(std::move(read->table));
    }
    return tables;
}

TEST(CoverTableFiles, AreFourAndCanBeRead) {
    EXPECT_EQ(cover_table_names(), (std::vector<std::string>{"cci", "corine", "nlcd", "worldcover"}));
    std::map<std::string, std::size_t> classes;
    for (const CoverTable& table : bundled_tables()) classes[table.name] = table.classes.size();
    // As their products' legends have them.
    EXPECT_EQ(classes, (std::map<std::string, std::size_t>{
                           {"cci", 37}, {"corine", 44}, {"nlcd", 20}, {"worldcover", 11}}));
}

TEST(CoverTableFiles, HaveFiguresThatCanBe) {
    for (const CoverTable& table : bundled_tables()) {
        for (const CoverClass& one : table.classes) {
            const std::string what = table.name + " " + one.name;
            EXPECT_LT(one.lowest_H_m, one.highest_H_m) << what;
            EXPECT_LE(one.canopy_m, 20.0) << what;
            EXPECT_TRUE(one.stems_per_ha == 0.0 || one.canopy_m >= 1.0) << what;
            const bool is_forest =
                one.materials.front() == Material::needle_forest ||
                (one.materials.front() == Material::broad_forest && one.materials.size() == 1);
            EXPECT_EQ(is_forest, one.stems_per_ha >= 150.0 && one.canopy_m >= 15.0 &&
                                     one.materials.back() != Material::wetland)
                << what;
        }
    }
}

// Lightness, green to red and blue to yellow. Source: CIE 15:2004, 8.2.1 (L*a*b*, white of D65), IEC
// 61966-2-1.
std::array<double, 3> lab_of(const CoverClass& one) {
    std::array<double, 3> light{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double code = one.colour[c] / 255.0;
        light[c] = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    }
    const auto root = [](double share) {
        return share > 0.008856 ? std::cbrt(share) : 7.787 * share + 16.0 / 116.0;
    };
    const double x = root((0.4124 * light[0] + 0.3576 * light[1] + 0.1805 * light[2]) / 0.9505),
                 y = root(0.2126 * light[0] + 0.7152 * light[1] + 0.0722 * light[2]),
                 z = root((0.0193 * light[0] + 0.1192 * light[1] + 0.9505 * light[2]) / 1.089);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

// Found: mangroves were 3.2 from tree cover, wetland 5.8 from shrubland, bare ground 6.9 from built-up, where
// 2.3 is what one just sees side by side. Source: M. Mahy and others, Evaluation of uniform color spaces,
// Color Research and Application 19(2), 1994.
TEST(CoverTableFiles, OfWorldCoverHaveColoursThatALegendTellsApart) {
    constexpr double least = 12.0;
    for (const CoverTable& table : bundled_tables()) {
        if (table.name != "worldcover") continue;
        for (std::size_t i = 0; i < table.classes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const auto one = lab_of(table.classes[i]), other = lab_of(table.classes[j]);
                EXPECT_GE(std::hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]), least)
                    << table.classes[i].name << " and " << table.classes[j].name;
            }
        }
    }
}

// The codes of files of these products: of Liechtenstein, Podlasie and Augusta, and of CORINE in both forms.
TEST(CoverTableFiles, AreRecognised) {
    const std::vector<CoverTable> tables = bundled_tables();
    const auto named = [&](const std::set<int>& codes) {
        const auto number = table_of_codes(tables, codes);
        return number.ok() ? tables[*number].name : number.error().what;
    };
    EXPECT_EQ(named({10, 20, 30, 40, 50, 60, 80, 90}), "worldcover");
    EXPECT_EQ(named({10, 11, 30, 40, 60, 61, 70, 90, 100, 110, 130, 180, 190, 210}), "cci");
    EXPECT_EQ(named({11, 21, 22, 23, 24, 31, 41, 42, 43, 52, 71, 81, 82, 90, 95}), "nlcd");
    EXPECT_EQ(named({112, 211, 231, 311, 312, 512}), "corine");
    EXPECT_EQ(named({2, 12, 18, 23, 24, 25, 26, 41}), "corine");
    EXPECT_EQ(named({10, 30, 60}),
              "its codes (10, 30, 60) fit several tables: name its table after a comma: cci and worldcover");
}

TEST(CoverTableFiles, AreNamedBehindAComma) {
    const auto choice = cover_choice_from({"a,b.tif,nlcd", "c.tif"});
    ASSERT_TRUE(choice.ok());
    EXPECT_EQ(*choice, (CoverChoice{{"a,b.tif", "c.tif"}, "nlcd"}));
    EXPECT_EQ(words_of(*choice), (std::vector<std::string>{"a,b.tif,nlcd", "c.tif,nlcd"}));
    EXPECT_EQ(cover_choice_from({"a,b.tif"})->files.front(), "a,b.tif");
    EXPECT_EQ(cover_choice_from({"a.tif,own.json"})->table, "own.json");
    const auto two = cover_choice_from({"a.tif,nlcd", "b.tif,cci"});
    ASSERT_FALSE(two.ok());
    EXPECT_EQ(two.error().kind, ErrorKind::usage);
    EXPECT_EQ(two.error().line(),
              "--landcover b.tif,cci: all files have one table, and an earlier one has nlcd");
}

TEST(CoverTableFiles, ThatAreWrongAreRefused) {
    const auto refusal = [](const std::string& text) {
        const auto table = cover_table_from(text, "t.json");
        return table.ok() ? "" : table.error().line();
    };
    const std::string fields = R"("name": "a", "colour": "#010203", "materials": ["rock"])";
    EXPECT_EQ(refusal(R"({"title": "t", "classes": [{"codes": [1], )" + fields + "}]}"), "");
    EXPECT_NE(refusal(R"({"title": "t", "classes": [{"codes": [1], )" + fields + R"(}, {"codes": [1], )" +
                      fields + "}]}")
                  .find("code 1 is there twice"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"title": "t", "classes": [{"codes": [1.5], )" + fields + "}]}").find("whole"),
              std::string::npos);
    EXPECT_NE(refusal(R"({"title": "t", "classes": [{"codes": [1], "name": "a", "colour": "#010203",)"
                      R"( "materials": ["cheese"]}]})")
                  .find("there is no material 'cheese'"),
              std::string::npos);
    EXPECT_NE(refusal("[]"), "");
    EXPECT_NE(refusal("{"), "");
}

}  // namespace
}  // namespace oro
