// Tables of numbers that commands write as .csv.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace oro::test {

// The rows below a first line, which must be `names`. What is missing, or a word, is no number.
inline std::vector<std::vector<double>> rows_of(const std::string& csv, const std::string& names) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(csv);
    std::string text;
    std::getline(lines, text);
    EXPECT_EQ(text, names);
    while (std::getline(lines, text)) {
        std::vector<double> row;
        std::istringstream words(text + ",");
        for (std::string word; std::getline(words, word, ',');) {
            char* end = nullptr;
            const double number = std::strtod(word.c_str(), &end);
            row.push_back(end == word.c_str() ? std::nan("") : number);
        }
        rows.push_back(row);
    }
    return rows;
}

}  // namespace oro::test
