#include "geo/vectors/csv_records.h"

#include <algorithm>
#include <optional>

#include "geo/files/foreign_text.h"
#include "geo/files/line_number.h"
#include "geo/vectors/coordinate_columns.h"

namespace oro {
namespace {

constexpr std::size_t longest_heading = std::size_t{1} << 16U;  // bytes in which a first line is looked for

std::vector<std::string> texts_of(const std::vector<CsvField>& fields) {
    std::vector<std::string> texts;
    texts.reserve(fields.size());
    for (const CsvField& field : fields) texts.push_back(field.text);
    return texts;
}

// The name that several columns of coordinates have; nothing where each has its own.
std::optional<std::string> name_of_several(const std::vector<std::string>& headings) {
    const CoordinateColumns columns = coordinate_columns(headings);
    for (const auto& column : {columns.x, columns.y}) {
        if (!column) continue;
        const std::string name = plain_heading(headings[*column]);
        if (std::ranges::count(headings, name, plain_heading) > 1) return headings[*column];
    }
    return std::nullopt;
}

}  // namespace

char csv_mark(std::string_view text) {
    if (const char named = CsvTable::named_mark(text); named != '\0') return named;
    char mark = ',';
    std::size_t most = 0;
    for (const char one : {'\t', ';', ',', '|'}) {
        CsvTable table(text.substr(0, longest_heading), one);
        std::vector<CsvField> heading;
        const auto any = table.next(heading);
        if (!any.ok() || !*any) continue;
        if (coordinate_columns(texts_of(heading)).kind != CoordinateColumns::Kind::none) return one;
        if (heading.size() > most) mark = one, most = heading.size();
    }
    return mark;
}

Result<CsvRecords> CsvRecords::of(std::string_view text) {
    CsvRecords records(text);
    std::vector<CsvField> heading;
    ORO_TRY(const bool has_heading, records.table_.next(heading));
    if (!has_heading) return records;
    records.headings_ = texts_of(heading);
    records.width_ = records.table_.width();
    if (const auto name = name_of_several(records.headings_))
        return records.table_.fault_at(records.table_.at(), "names two columns '" + foreign_text(*name) +
                                                                "': which of them counts is not clear");
    return records;
}

Error CsvRecords::too_wide() const {
    std::string what = "has " + std::to_string(table_.width()) + " fields, and the first line names " +
                       std::to_string(width_);
    if (mark() == ',')
        what +=
            ": a text with a comma needs quotation marks, and decimal commas need semicolons between fields";
    return table_.fault_at(table_.at(), what);
}

Result<bool> CsvRecords::next(std::vector<CsvField>& fields) {
    ORO_TRY(const bool more, table_.next(fields));
    if (!more) return false;
    if (table_.width() > width_) return too_wide();
    if (table_.width() < width_ && table_.is_at_end())
        return table_.fault_at(table_.at(), "is the last one and has " + std::to_string(table_.width()) +
                                                " of " + std::to_string(width_) +
                                                " fields and no end: the file is cut");
    fields.resize(headings_.size());
    return true;
}

std::size_t CsvRecords::line() {
    line_ += line_number(text_.substr(counted_), at() - counted_) - 1;
    counted_ = at();
    return line_;
}

}  // namespace oro
