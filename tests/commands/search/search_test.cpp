// What a search field takes, and what it finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "apps/search/folded_text.h"
#include "apps/search/name_table.h"
#include "apps/search/search_index.h"

namespace {
using namespace oro;

TEST(FoldedText, LeavesOutWhatPeopleLeaveOut) {
    for (const auto& [text, letters] : std::vector<std::pair<std::string, std::string>>{
             {"Zürich", "zurich"},
             {"ZU\u0308RICH", "zurich"},  // a combining diaeresis
             {"L'Aiguille-Verte ", "l aiguille verte"},
             {"l\u2019Aiguille  Verte", "l aiguille verte"},
             {"Grosse Scheidegg", "grosse scheidegg"},
             {"Große Scheidegg", "grosse scheidegg"},
             {"Łódź, Tromsø", "lodz tromso"},
             {"Ærø", "aero"},
             {"Œuvre", "oeuvre"},
             {"Ïñtërnâtiônàlizætiøn", "internationalizaetion"},
             {"Þórsmörk", "thorsmork"},
             {"Đakovo", "dakovo"},
             {"Făgăraș", "fagaras"},
             {"Fansipan (Phan Xi Păng) \u1ebe", "fansipan phan xi pang e"},
             {"\u1e9e", "ss"},
             {"Ёлка Йошкар", "елка иошкар"},
             {"Όλυμπος", "ολυμποσ"},
             {"富士山", "富士山"},
             {"K2", "k2"},
             {" - ", ""},
             {"", ""},
             {"a\xff"
              "b",
              "a b"},
             {"\xf0\x9f\x8f\x94", "\xf0\x9f\x8f\x94"}})
        EXPECT_EQ(folded(text), letters) << text;
}

SearchPlace summit(const std::string& name, double H_m) {
    return {name, 46.5, 8.0, H_m, PlaceClass::summit, 0.0};
}

std::vector<std::string> found_in(const NameTable& table, const std::string& text, std::size_t limit = 10) {
    std::vector<std::string> names;
    for (const NameTable::Found& found : table.find(folded(text), limit))
        names.push_back(table.place(found.number).name);
    return names;
}

TEST(NameTable, WholeNamesThenBeginningsThenWordsThenParts) {
    using Names = std::vector<std::string>;
    const NameTable table({summit("Eigergletscher", 2320.0), summit("Klein Eiger", 3472.0),
                           summit("Eiger", 3967.0), summit("Weigert", 500.0), summit("Eigeralp", 1900.0),
                           summit("Mönch", 4110.0), summit("Grosser Eiger Kleiner Eiger", 100.0)});
    EXPECT_EQ(found_in(table, "eiger"), (Names{"Eiger", "Eigergletscher", "Eigeralp", "Klein Eiger",
                                               "Grosser Eiger Kleiner Eiger", "Weigert"}));
    EXPECT_EQ(found_in(table, "EIGER", 2), (Names{"Eiger", "Eigergletscher"}));
    EXPECT_EQ(found_in(table, "monch"), Names{"Mönch"});
    EXPECT_EQ(found_in(table, "eiger kl"), Names{"Grosser Eiger Kleiner Eiger"});
    EXPECT_EQ(found_in(table, "zzz"), Names{});
    EXPECT_EQ(found_in(table, ""), Names{});
    EXPECT_EQ(found_in(table, "eiger", 0), Names{});
    EXPECT_EQ(found_in(NameTable(), "eiger"), Names{});
    EXPECT_EQ(found_in(NameTable(std::vector<SearchPlace>()), "eiger"), Names{});
}

TEST(NameTable, ATownCountsAsAsHighAsItsPeopleMakeIt) {
    const NameTable table({{"Bern", 46.9, 7.4, 540.0, PlaceClass::settlement, 133'883.0},
                           {"Bernina", 46.4, 9.9, 4049.0, PlaceClass::summit, 0.0},
                           {"Bernex", 46.2, 6.1, 447.0, PlaceClass::settlement, 10'000.0},
                           {"Bernau", 47.8, 8.0, 900.0, PlaceClass::other, 0.0}});
    EXPECT_EQ(found_in(table, "be"), (std::vector<std::string>{"Bern", "Bernina", "Bernex", "Bernau"}));
    EXPECT_NEAR(importance_of(table.place(0)), 5126.7, 0.1);  // 1000 log10(133883)
}

// Brute force: each name looked at by itself.
TEST(NameTable, FindsWhatLookingAtEachNameFinds) {
    const unsigned seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto letters = [&](std::size_t most) {
        std::string text;
        for (std::size_t i = 0, count = 1 + random() % most; i < count; ++i) text += "ab c"[random() % 4];
        return text;
    };
    std::vector<SearchPlace> places;
    for (int i = 0; i < 3000; ++i) places.push_back(summit(letters(12), static_cast<double>(random() % 50)));
    std::erase_if(places, [](const SearchPlace& place) { return folded(place.name).empty(); });
    const NameTable table(places);
    for (int i = 0; i < 300; ++i) {
        const std::string text = folded(letters(4));
        if (text.empty()) continue;
        std::vector<std::pair<NameMatch, std::uint32_t>> all;
        for (std::uint32_t number = 0; number < table.size(); ++number) {
            const std::string name = folded(table.place(number).name);
            if (name == text)
                all.emplace_back(NameMatch::whole, number);
            else if (name.starts_with(text))
                all.emplace_back(NameMatch::beginning, number);
            else if ((" " + name).find(" " + text) != std::string::npos)
                all.emplace_back(NameMatch::beginning_of_word, number);
            else if (name.find(text) != std::string::npos)
                all.emplace_back(NameMatch::within, number);
        }
        std::ranges::sort(all);
        const std::size_t limit = 1 + random() % 40;
        all.resize(std::min(all.size(), limit));
        std::vector<std::pair<NameMatch, std::uint32_t>> found;
        for (const NameTable::Found& one : table.find(text, limit)) found.emplace_back(one.match, one.number);
        ASSERT_EQ(found, all) << "'" << text << "', limit " << limit;
    }
    for (std::uint32_t number = 1; number < table.size(); ++number)
        ASSERT_GE(importance_of(table.place(number - 1)), importance_of(table.place(number)));
}

SearchIndex swiss_index() {
    SearchIndex index;
    index.set_points(
        NameTable({summit("Eiger", 3967.0), {"Eigerhütte", 46.56, 8.0, 2320.0, PlaceClass::other, 0.0}}));
    index.set_gazetteer(NameTable({{"Eigergrat", 46.57, 8.01, 3500.0, PlaceClass::other, 0.0},
                                   {"Grindelwald", 46.62, 8.03, 1034.0, PlaceClass::settlement, 3800.0},
                                   {"K2", 35.88, 76.51, 8611.0, PlaceClass::summit, 0.0}}));
    index.set_bookmarks({{"Eigerblick", 46.6, 8.02, BookmarkedEye{2100.0, 190.0, 5.0, 0.0, 30.0}},
                         {"Zuhause", 46.7, 7.6, {}}});
    index.set_crs(CrsPlaces::of("EPSG:2056", CrsPlaces::Reach::anywhere).value());
    return index;
}

TEST(SearchIndex, CompletesFromAllItsSources) {
    const SearchIndex index = swiss_index();
    const auto names = [&](const std::string& text, std::size_t limit) {
        std::vector<std::string> all;
        for (const SearchMatch& match : index.matches(text, limit)) all.push_back(match.place.name);
        return all;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names("eiger", 10), (Names{"Eiger", "Eigerblick", "Eigerhütte", "Eigergrat"}));
    EXPECT_EQ(names("eiger", 2), (Names{"Eiger", "Eigerblick"}));
    EXPECT_EQ(names("EIGERHU", 10), Names{"Eigerhütte"});
    EXPECT_EQ(names("wald", 10), Names{"Grindelwald"});
    EXPECT_TRUE(names("", 10).empty());
    EXPECT_EQ(index.matches("eigerb", 1).front().source, NameSource::bookmark);
    EXPECT_EQ(index.matches("eigerb", 1).front().eye->heading_deg, 190.0);
}

TEST(SearchIndex, KnowsWhatToDoAboutAText) {
    const SearchIndex index = swiss_index();
    const auto expect_target = [&](const std::string& text, SearchAction action, double lat_deg,
                                   double lon_deg) {
        const auto target = index.resolve(text);
        ASSERT_TRUE(target.ok()) << text << ": " << target.error().line();
        EXPECT_EQ(static_cast<int>(target->action), static_cast<int>(action)) << text;
        EXPECT_NEAR(target->place.lat_deg, lat_deg, 1e-8) << text;
        EXPECT_NEAR(target->place.lon_deg, lon_deg, 1e-8) << text;
    };
    expect_target("N46E008", SearchAction::frame, 46.5, 8.5);
    expect_target(" n46e008 ", SearchAction::frame, 46.5, 8.5);
    expect_target("8,46,9,47", SearchAction::frame, 46.5, 8.5);
    expect_target("179,-1,-179,1", SearchAction::frame, 0.0, 180.0);
    expect_target("46.57,7.99", SearchAction::show, 46.57, 7.99);
    expect_target("46°30'N 8°15'E", SearchAction::show, 46.5, 8.25);
    expect_target("2642950,1166825", SearchAction::show, 46.6512836892845, 7.99970586595196);
    expect_target("2'642'950 / 1'166'825", SearchAction::show, 46.6512836892845, 7.99970586595196);
    expect_target("en 2642950 1166825", SearchAction::show, 46.6512836892845, 7.99970586595196);
    expect_target("EPSG:32632 500000,4982950.4002", SearchAction::show, 45.0, 9.0);
    expect_target("Eiger", SearchAction::stand, 46.5, 8.0);
    expect_target("eig", SearchAction::view, 46.6, 8.02);  // of names that begin so a bookmark comes first
    expect_target("grindel", SearchAction::show, 46.62, 8.03);
    expect_target("ZUHAUSE", SearchAction::show, 46.7, 7.6);
    // A geohash in Africa by its letters, and a name that is known.
    expect_target("k2", SearchAction::stand, 35.88, 76.51);
    expect_target("u0m6", SearchAction::frame, parse_place("u0m6")->lat_deg, parse_place("u0m6")->lon_deg);
    const auto box = index.resolve("2640000,1160000,2660000,1180000");
    ASSERT_TRUE(box.ok()) << box.error().line();
    ASSERT_TRUE(box->place.cell);
    // By gdaltransform: the SW, SE, NE and NW corners; the southern side is lowest at its eastern end.
    EXPECT_NEAR(box->place.cell->west_deg, 7.96057788202655, 1e-8);
    EXPECT_NEAR(box->place.cell->south_deg, 46.5885785717463, 1e-8);
    EXPECT_NEAR(box->place.cell->east_deg, 8.22414443047565, 1e-8);
    EXPECT_NEAR(box->place.cell->north_deg, 46.7699794561827, 1e-8);
    EXPECT_EQ(index.resolve("eigerblick")->eye->vertical_fov_deg, 30.0);
}

TEST(SearchIndex, SaysWhatIsWrongInOneLine) {
    const SearchIndex index = swiss_index(), bare;
    const auto wrong = [](const SearchIndex& of, const std::string& text) {
        const auto target = of.resolve(text);
        EXPECT_FALSE(target.ok()) << text;
        if (target.ok()) return std::string();
        EXPECT_EQ(target.error().kind, ErrorKind::usage);
        EXPECT_EQ(target.error().where, "");
        EXPECT_EQ(target.error().what.find('\n'), std::string::npos);
        return target.error().what;
    };
    EXPECT_EQ(wrong(index, "  "), "type a place: 46.57,7.99, a cell such as N46E008, or a name");
    const std::string unknown =
        "no place of this name is known here; a file of places (GPX, KML, GeoJSON) that is opened adds its "
        "names, and `orograph fetch --source peaks` gets such a file from OpenStreetMap";
    EXPECT_EQ(wrong(index, "Nanga Parbat"), unknown);
    EXPECT_EQ(wrong(bare, "Eiger"), unknown);
    EXPECT_EQ(wrong(index, "8,47,9,46"), "south must lie below north; the order is west,south,east,north");
    EXPECT_NE(wrong(index, "91,8").find("latitude 91 is outside [-90, 90]"), std::string::npos);
    EXPECT_EQ(wrong(index, "99999,99999999").find("latitude"), std::string::npos);
    EXPECT_NE(wrong(bare, "2642950,1166825").find("write the CRS before them: EPSG:2056 2642950,1166825"),
              std::string::npos);
    EXPECT_NE(wrong(bare, "en 2642950,1166825").find("the data have no CRS"), std::string::npos);
    EXPECT_NE(wrong(index, "EPSG:999999 1,2").find("EPSG:999999 is no coordinate reference system"),
              std::string::npos);
    EXPECT_NE(wrong(index, "EPSG:2056 642950,166825").find("outside the area of use"), std::string::npos);
    EXPECT_EQ(wrong(index, "32T 1 2 3").find("not looked up"), std::string::npos);
}

}  // namespace
