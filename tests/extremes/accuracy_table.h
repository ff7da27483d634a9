// What the extremes measured, as the tables of docs/ACCURACY.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace oro::test {

// One line of a table: what is measured of a case, and what it must keep. All rows are listed in one place
// (accuracy_rows.cpp), so that a page can be held against them without drawing anything.
struct AccuracyRow {
    const char* group;     // heading of its table
    const char* name;      // the case, unique within its group
    const char* measured;  // what of it; of several values the worst
    const char* against;   // what is taken for the truth
    double bound;
    const char* unit;   // "" for a plain number
    const char* count;  // what `over` of measured() counts: "pixels"
    const char* remark;
    bool at_least{false};  // the bound is one from below: of what is there to be compared with
};
std::span<const AccuracyRow> accuracy_rows();

// Records a value of a row and holds it against the row's bound (a failed expectation, and one for a row that
// is not listed). Measured several times: the worst counts, and `over` adds up.
void measured(const std::string& group, const std::string& name, double value, std::uint64_t over);

// The tables with what was measured so far, in the order of accuracy_rows(); rows that were not measured say
// so. drawn_on: device and driver.
std::string accuracy_tables(const std::string& drawn_on);
// Names of rows that were not measured, "group: name".
std::vector<std::string> rows_not_measured();

// "group: name" of each row of the tables in a page.
std::vector<std::string> rows_of_page(const std::string& markdown);

// Remembers what draws, for the tables.
void drawn_on(const std::string& device_and_driver);

}  // namespace oro::test
