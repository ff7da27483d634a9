// How deep and how long any JSON may be that this program reads: views, styles, what auto has measured, the
// description in a baked region, paths of a benchmark. Asked before a text is parsed: parsed JSON is copied,
// told and freed by recursion, and takes many times its text's size.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace oro {

struct JsonBounds {
    int deepest{16};  // lists and objects in each other; the program's own go to 4
    std::size_t most_values{1'000'000};
    std::size_t most_bytes{std::size_t{16} << 20};
};

// What is too much in a text, for people; nothing where it is within the bounds. The text need not be JSON: a
// parser that stops at a fault has by then met no more than is counted here.
[[nodiscard]] std::optional<std::string> beyond_json_bounds(std::string_view text,
                                                            const JsonBounds& bounds = {});

}  // namespace oro
