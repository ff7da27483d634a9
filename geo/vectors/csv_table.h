// Tables of text: lines of fields with a mark between them (RFC 4180, and what spreadsheets write).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace oro {

struct CsvField {
    std::string text;  // without quotation marks and the blanks around it
    bool is_quoted{};  // so that a mark in it is no end of it
};

// A text that is read record by record; it must outlive this.
class CsvTable {
  public:
    // Begins behind a first line `sep=;`, as Excel writes one, whose mark counts then.
    CsvTable(std::string_view text, char mark);
    // The mark that a first line `sep=;` names, or 0.
    static char named_mark(std::string_view text);

    // The next record with a text in it, as far as its last one; a field in quotation marks may hold ends of
    // lines. False after the last. Errors (a reason with its line, without the file's name): a quotation mark
    // without an end; a text right behind a field in quotation marks.
    Result<bool> next(std::vector<CsvField>& fields);
    // How many fields that record has, those without a text at its end included.
    [[nodiscard]] std::size_t width() const { return width_; }
    // The byte of the text where the record that next() gave begins, and whether the text ends with it,
    // without an end of its line.
    [[nodiscard]] std::size_t at() const { return record_at_; }
    [[nodiscard]] bool is_at_end() const { return at_ == text_.size(); }
    [[nodiscard]] char mark() const { return mark_; }
    // A reason with the number of the line in which a byte stands: "line 3 has ...".
    [[nodiscard]] Error fault_at(std::size_t at, const std::string& what) const;

  private:
    Result<void> field(CsvField& field);

    std::string_view text_;
    char mark_;
    std::size_t at_{};
    std::size_t record_at_{};
    std::size_t width_{};
};

}  // namespace oro
