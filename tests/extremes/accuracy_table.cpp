#include "tests/extremes/accuracy_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>

#include "geo/files/whole_file.h"
#include "tests/extremes/gpu_scan.h"

namespace oro::test {
namespace {

struct Measured {
    double value;
    std::uint64_t over;
};
// Of this run of the program; tests run one after the other.
std::map<std::string, Measured>& record() {
    static std::map<std::string, Measured> all;
    return all;
}
std::string& device() {
    static std::string name;
    return name;
}

std::string key_of(const std::string& group, const std::string& name) {
    return group + ": " + name;
}
std::string key_of(const AccuracyRow& row) {
    return key_of(row.group, row.name);
}

// Two digits, so that a table of another run reads the same where nothing changed.
std::string number(double value) {
    char text[40];
    const double size = std::abs(value);
    if (value == std::round(value) && size < 1e7)
        std::snprintf(text, sizeof text, "%.0f", value);
    else if (size >= 1e-4 && size < 1e5)
        std::snprintf(text, sizeof text, "%.*f",
                      std::max(0, 1 - static_cast<int>(std::floor(std::log10(size)))), value);
    else
        std::snprintf(text, sizeof text, "%.1e", value);
    return text;
}

std::string with_unit(const std::string& text, const char* unit) {
    return text + (*unit ? " " : "") + unit;
}

// A bound as it is written in the source.
std::string bound_of(const AccuracyRow& row) {
    char text[40];
    std::snprintf(text, sizeof text, "%g", row.bound);
    return (row.at_least ? "at least " : "") + with_unit(text, row.unit);
}

std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

std::string line_of(const AccuracyRow& row) {
    const auto found = record().find(key_of(row));
    const bool there = found != record().end();
    std::ostringstream line;
    line << "| " << row.name << " | " << row.measured << " | " << row.against << " | "
         << (there ? grouped(found->second.over) + " " + row.count : "") << " | "
         << (there ? with_unit(number(found->second.value), row.unit) : "not measured") << " | "
         << bound_of(row) << " | " << row.remark << " |\n";
    return line.str();
}

// Writes the tables where OROGRAPH_ACCURACY_TABLE says, after all tests.
class TableWriter : public ::testing::Environment {
  public:
    void TearDown() override {
        const GpuScan scan = scanned();
        if (scan.floats > 0)
            measured("No data, odd data", "everything sent to the GPU in all these cases",
                     static_cast<double>(scan.not_finite), scan.floats);
        const char* const file = std::getenv("OROGRAPH_ACCURACY_TABLE");
        if (!file) return;
        for (const std::string& row : rows_not_measured()) ADD_FAILURE() << "not measured: " << row;
        if (::testing::UnitTest::GetInstance()->Failed()) {
            ADD_FAILURE() << "something failed: no table is written";
            return;
        }
        const auto written = write_whole_file(file, accuracy_tables(device()), true);
        EXPECT_TRUE(written.ok()) << written.error().line();
    }
};
const auto* const table_writer = ::testing::AddGlobalTestEnvironment(new TableWriter);

}  // namespace

void measured(const std::string& group, const std::string& name, double value, std::uint64_t over) {
    const std::string key = key_of(group, name);
    const auto rows = accuracy_rows();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const AccuracyRow& one) { return key_of(one) == key; });
    if (row == rows.end()) {
        ADD_FAILURE() << "no row is listed for " << key;
        return;
    }
    std::printf("%s: %s over %s %s\n", key.c_str(), with_unit(number(value), row->unit).c_str(),
                grouped(over).c_str(), row->count);
    // Written so that a NaN fails, too.
    if (row->at_least)
        EXPECT_TRUE(value >= row->bound) << key << ": " << value << " " << row->unit;
    else
        EXPECT_TRUE(value <= row->bound) << key << ": " << value << " " << row->unit;
    const auto [at, added] = record().try_emplace(key, Measured{value, over});
    if (added) return;
    at->second.value = row->at_least ? std::min(at->second.value, value) : std::max(at->second.value, value);
    at->second.over += over;
}

std::string accuracy_tables(const std::string& drawn_on) {
    std::string text = "Drawn on " + drawn_on + ".\n";
    const char* group = nullptr;
    for (const AccuracyRow& row : accuracy_rows()) {
        if (!group || std::string(group) != row.group) {
            group = row.group;
            text += std::string("\n### ") + group +
                    "\n\n| case | the worst of | held against | over | measured | bound | remark |\n"
                    "|---|---|---|---|---|---|---|\n";
        }
        text += line_of(row);
    }
    return text;
}

std::vector<std::string> rows_not_measured() {
    std::vector<std::string> keys;
    for (const AccuracyRow& row : accuracy_rows()) {
        if (!record().contains(key_of(row))) keys.push_back(key_of(row));
    }
    return keys;
}

std::vector<std::string> rows_of_page(const std::string& markdown) {
    std::vector<std::string> keys;
    std::istringstream lines(markdown);
    std::string group;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("<!-- tables: end")) break;
        if (line.starts_with("### ")) group = line.substr(4);
        if (!line.starts_with("| ") || line.starts_with("| case |")) continue;
        const std::size_t end = line.find(" | ", 2);
        if (end != std::string::npos) keys.push_back(key_of(group, line.substr(2, end - 2)));
    }
    return keys;
}

void drawn_on(const std::string& device_and_driver) {
    device() = device_and_driver;
}

}  // namespace oro::test
