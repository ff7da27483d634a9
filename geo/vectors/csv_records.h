// Tables of text whose first line names their columns (CSV): what all commands read of them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "geo/vectors/csv_table.h"

namespace oro {

// The mark between the fields of a text: the one that a first line `sep=;` names; else that of comma,
// semicolon, tab and | with which the first line names columns of coordinates; else the one that parts it
// into most fields.
char csv_mark(std::string_view text);

// Reads a table record by record. The text must outlive it.
class CsvRecords {
  public:
    // Reads the first line. Errors (a reason with its line, without the file's name): those of
    // CsvTable::next(); two columns of coordinates that have the same name.
    static Result<CsvRecords> of(std::string_view text);

    // The names in the first line, in its order; none where the text is empty.
    [[nodiscard]] const std::vector<std::string>& headings() const { return headings_; }
    // The next record with a text in it: a field for each heading, empty where the line ends before. False
    // after the last. Errors (a reason with its line, without the file's name): those of CsvTable::next();
    // more fields than headings; a last line that has fewer and no end, as where a file was cut.
    Result<bool> next(std::vector<CsvField>& fields);
    // The byte of the text where the record that next() gave begins, and its number, from 1, of the line.
    [[nodiscard]] std::size_t at() const { return table_.at(); }
    [[nodiscard]] std::size_t line();
    [[nodiscard]] char mark() const { return table_.mark(); }

  private:
    explicit CsvRecords(std::string_view text) : text_(text), table_(text, csv_mark(text)) {}
    [[nodiscard]] Error too_wide() const;

    std::string_view text_;
    CsvTable table_;
    std::vector<std::string> headings_;
    std::size_t width_{};              // fields of the first line
    std::size_t counted_{}, line_{1};  // lines are counted up to a byte, which stands in that one
};

}  // namespace oro
