// JSON that is read where it stands: a file of a gigabyte is never a tree of objects.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A value in a text that check_json() found whole. The text must outlive it.
class JsonValue {
  public:
    enum class Kind { object, array, text, number, boolean, null };
    // The value whose first byte stands at `at`.
    JsonValue(std::string_view text, std::size_t at) : text_(text), at_(at) {}

    [[nodiscard]] Kind kind() const;
    [[nodiscard]] bool is(Kind kind) const { return this->kind() == kind; }
    // The byte of the text where it begins.
    [[nodiscard]] std::size_t at() const { return at_; }
    // The value as it is written.
    [[nodiscard]] std::string_view source() const;
    // Of an object, in the order of the file, names as often as they stand there; of others none.
    [[nodiscard]] std::vector<std::pair<std::string, JsonValue>> members() const;
    // Calls what(value) for each element of an array, and for none of anything else, until it returns false.
    template <class What>
    void each(What&& what) const {
        if (!is(Kind::array)) return;
        for (std::size_t at = first_within(at_ + 1); text_[at] != ']'; at = after_comma(end_of(at)))
            if (!what(JsonValue(text_, at))) return;
    }
    // The characters of a text, in UTF-8 as far as the file has it; of others "".
    [[nodiscard]] std::string text() const;
    // The whole value as a person reads it: the characters of a text, "" for null, else what is written.
    [[nodiscard]] std::string words() const;

  private:
    [[nodiscard]] std::size_t end_of(std::size_t at) const;
    [[nodiscard]] std::size_t first_within(std::size_t at) const;
    [[nodiscard]] std::size_t after_comma(std::size_t at) const;

    std::string_view text_;
    std::size_t at_;
};

// Checks the first value from byte `from` on and gives the byte after it. Beside JSON it lets through what
// programs write that know no better: NaN and Infinity, numbers that are none (`01`, `+5`, `.5`, `1.`: kind
// number) and raw control characters in texts. Errors (a reason, without the file's name): the line and what
// is wrong there; values within values more than 128 deep.
Result<std::size_t> check_json(std::string_view text, std::size_t from);

}  // namespace oro
