// docs/ACCURACY.md has the rows that this suite measures, so that it cannot go stale unseen.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "tests/extremes/accuracy_table.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

std::string page() {
    std::ifstream file(bundled_data().parent_path() / "docs" / "ACCURACY.md");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(AccuracyPage, HasTheRowsOfTheSuite) {
    std::vector<std::string> listed;
    for (const AccuracyRow& row : accuracy_rows()) listed.push_back(std::string(row.group) + ": " + row.name);
    EXPECT_EQ(rows_of_page(page()), listed) << "scripts/accuracy makes the tables again";
    EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()).size(), listed.size());
}

TEST(AccuracyPage, HasAValueInEachRow) {
    EXPECT_EQ(page().find("not measured"), std::string::npos);
    EXPECT_NE(page().find("Drawn on "), std::string::npos);
}

TEST(AccuracyPage, TablesNameWhatWasNotMeasured) {
    const std::string tables = accuracy_tables("a device, a driver");
    EXPECT_EQ(rows_of_page(tables).size(), accuracy_rows().size());
    EXPECT_EQ(tables.find("Drawn on a device, a driver.\n"), 0U);
    // In a program of its own this case measures nothing.
    if (rows_not_measured().size() == accuracy_rows().size()) {
        EXPECT_NE(tables.find("| not measured |"), std::string::npos);
    }
}

}  // namespace
}  // namespace oro::test
