// Numbers from texts of options.
#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace oro {

// False where the text is not one number and nothing else; `value` is then of no use.
template <class Number>
bool read_whole(std::string_view text, Number& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

}  // namespace oro
