#include "geo/vectors/table_text.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <utf8.h>

#include <cstdint>
#include <span>
#include <utility>

#include "core/base/open_file.h"
#include "geo/files/raster_library.h"
#include "geo/files/text_encoding.h"
#include "geo/vectors/vector_file.h"

namespace oro {
namespace {

// Text of a spreadsheet of old in UTF-8; as it is where the library cannot turn it.
std::string from_windows_1252(const std::string& text) {
    const GdalMessages unsaid;
    char* const turned = CPLRecode(text.c_str(), "CP1252", CPL_ENC_UTF8);
    std::string utf8 = turned != nullptr ? turned : text;
    CPLFree(turned);
    return utf8;
}

}  // namespace

Result<TableText> utf8_table(std::string bytes) {
    TableText table;
    ORO_TRY(table.text, utf8_text(std::move(bytes)));
    if (table.text.find('\0') != std::string::npos)
        return Error{
            ErrorKind::failed, "",
            "is no text, or UTF-16 without a byte order mark (it holds zero bytes): save it as UTF-8"};
    if (!utf8::is_valid(table.text.begin(), table.text.end())) {
        table.text = from_windows_1252(table.text);
        table.note = "is no UTF-8 and is read as Windows-1252";
    }
    return table;
}

Result<TableText> read_table_text(const std::string& file) {
    ORO_TRY(const OpenFile opened, OpenFile::open(file, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, opened.size());
    if (size > longest_vector_text)
        return Error{ErrorKind::failed, file, "is longer than 1 GiB, which is the limit of a table"};
    std::string bytes(size, '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(bytes))));
    Result<TableText> table = utf8_table(std::move(bytes));
    if (!table.ok()) return Error{ErrorKind::failed, file, table.error().what};
    return table;
}

}  // namespace oro
