// Coordinates as a file of text writes them: numbers, and what is none.
#pragma once

#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace oro {

// Why a place of a file is none, as the end of "places of lines ...".
namespace no_place {
inline constexpr const char* no_numbers = "that are no numbers";
inline constexpr const char* not_finite = "that are no finite numbers";
inline constexpr const char* half = "without a latitude or without a longitude";
inline constexpr const char* too_many = "of more than three numbers";
}  // namespace no_place

// A number that fills the whole word but for spaces around it, with a point for decimals; what is too large
// for a double is infinite. `fault`: null, or why there is none.
struct WrittenNumber {
    double value{std::numeric_limits<double>::quiet_NaN()};
    const char* fault{};
};

inline WrittenNumber written_number(std::string_view word) {
    constexpr std::string_view space = " \t\r\n";
    const std::size_t begin = word.find_first_not_of(space);
    if (begin == std::string_view::npos) return {.fault = no_place::half};
    word = word.substr(begin, word.find_last_not_of(space) + 1 - begin);
    if (word.starts_with('+') && word.find_first_of("+-", 1) != 1) word.remove_prefix(1);
    WrittenNumber number;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number.value);
    if (end != word.data() + word.size() || fault == std::errc::invalid_argument)
        return {.fault = no_place::no_numbers};
    // Too large, or too small, which is 0.
    if (fault == std::errc::result_out_of_range)
        number.value = std::strtod(std::string(word).c_str(), nullptr);
    if (!std::isfinite(number.value)) number.fault = no_place::not_finite;
    return number;
}

// A text that is a number with a power of ten (1.2e3), without it as far as that is short; any other as it
// is.
inline std::string without_power(std::string text) {
    if (text.find_first_of("eE") == std::string::npos) return text;
    const WrittenNumber number = written_number(text);
    if (number.fault != nullptr) return text;
    char plain[40];
    std::snprintf(plain, sizeof plain, "%.15g", number.value);
    return plain;
}

// The places of a point, a line or a ring, in the order of the file. One whose x or y is no finite number is
// among `faults`.
struct TextPath {
    struct Fault {
        std::size_t place;
        const char* why;
        std::string word;  // what stands in the file
    };
    std::vector<double> x, y, z;     // z: NaN where there is no height
    std::vector<std::size_t> at;     // byte of the text where a place begins; empty: unknown
    std::vector<Fault> faults;       // by place, ascending
    std::size_t faulty_heights{};    // that are no numbers
    std::size_t faulty_height_at{};  // the first of them

    [[nodiscard]] std::size_t size() const { return x.size(); }

    // Appends a place as it is written; z "" for none.
    void add(std::string_view x_word, std::string_view y_word, std::string_view z_word,
             std::size_t place_at) {
        const WrittenNumber x_number = written_number(x_word), y_number = written_number(y_word);
        if (x_number.fault != nullptr || y_number.fault != nullptr) {
            // The lesser fault is told where the other number is fine, or missing.
            const bool of_x = x_number.fault != nullptr && x_number.fault != no_place::half;
            const char* const why = of_x || y_number.fault == nullptr ? x_number.fault : y_number.fault;
            faults.push_back({size(), why, std::string(of_x || y_number.fault == nullptr ? x_word : y_word)});
        }
        const WrittenNumber z_number = written_number(z_word);
        if (z_number.fault == no_place::no_numbers && faulty_heights++ == 0) faulty_height_at = place_at;
        x.push_back(x_number.value), y.push_back(y_number.value), z.push_back(z_number.value);
        at.push_back(place_at);
    }
    // Appends what stands where a place should.
    void add_fault(const char* why, std::string_view word, std::size_t place_at) {
        constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
        faults.push_back({size(), why, std::string(word)});
        x.push_back(no_number), y.push_back(no_number), z.push_back(no_number);
        at.push_back(place_at);
    }
};

}  // namespace oro
