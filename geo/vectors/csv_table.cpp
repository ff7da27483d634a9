#include "geo/vectors/csv_table.h"

#include <algorithm>
#include <cctype>

#include "geo/files/foreign_text.h"
#include "geo/files/line_number.h"

namespace oro {
namespace {

constexpr std::string_view csv_blanks = " \t";

bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

void trim(std::string& text) {
    const std::size_t last = text.find_last_not_of(csv_blanks);
    text.resize(last == std::string::npos ? 0 : last + 1);
    text.erase(0, std::min(text.find_first_not_of(csv_blanks), text.size()));
}

// The beginning of a text.
std::string shown(const std::string& text) {
    constexpr std::size_t longest = 20;
    if (text.size() <= longest) return foreign_text(text);
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // whole letters
    return foreign_text(text.substr(0, end)) + "...";
}

}  // namespace

Error CsvTable::fault_at(std::size_t at, const std::string& what) const {
    return {ErrorKind::failed, "", "line " + std::to_string(line_number(text_, at)) + " " + what};
}

char CsvTable::named_mark(std::string_view text) {
    const bool is_named = text.size() > 5 && text.starts_with("sep=") && is_line_end(text[5]);
    return is_named ? text[4] : '\0';
}

CsvTable::CsvTable(std::string_view text, char mark) : text_(text), mark_(mark) {
    if (named_mark(text) != '\0') mark_ = named_mark(text), at_ = 5;
}

// Reads a field from at_ on, which then stands on its mark, on its line's end or at the text's.
Result<void> CsvTable::field(CsvField& field) {
    field.text.clear();
    field.is_quoted = false;
    while (at_ < text_.size() && text_[at_] == ' ' && text_[at_] != mark_) ++at_;
    if (at_ < text_.size() && text_[at_] == '"') {
        field.is_quoted = true;
        const std::size_t begin = at_++;
        for (;;) {
            const std::size_t end = text_.find('"', at_);
            if (end == std::string_view::npos)
                return fault_at(begin,
                                "has a quotation mark without an end: all lines behind it are in one field");
            field.text += text_.substr(at_, end - at_);
            at_ = end + 1;
            if (at_ == text_.size() || text_[at_] != '"') break;
            field.text += text_[at_++];  // two of them are one
        }
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != mark_ && !is_line_end(text_[at_])) ++at_;
    std::string rest(text_.substr(begin, at_ - begin));
    trim(rest);
    if (field.is_quoted && !rest.empty())
        return fault_at(begin,
                        "has '" + shown(rest) +
                            "' behind a field in quotation marks: a quotation mark within such a field is "
                            "written twice");
    field.text += rest;
    trim(field.text);
    return {};
}

Result<bool> CsvTable::next(std::vector<CsvField>& fields) {
    for (;;) {
        while (at_ < text_.size() && is_line_end(text_[at_])) ++at_;
        if (at_ == text_.size()) return false;
        record_at_ = at_;
        std::size_t count = 0;
        for (;;) {
            if (count == fields.size()) fields.emplace_back();
            ORO_CHECK(field(fields[count++]));
            if (at_ == text_.size() || text_[at_] != mark_) break;
            ++at_;
        }
        width_ = count;
        while (count > 0 && fields[count - 1].text.empty()) --count;
        if (count == 0) continue;
        fields.resize(count);
        return true;
    }
}

}  // namespace oro
