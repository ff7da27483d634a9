#include "apps/search/text_lines.h"

#include <algorithm>
#include <span>
#include <utility>

namespace oro {

Result<TextLines> TextLines::of(const std::string& path) {
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    return TextLines(std::move(file), size);
}

Result<void> TextLines::fill() {
    constexpr std::uint64_t block_bytes = std::uint64_t{1} << 20U;
    block_.resize(static_cast<std::size_t>(std::min(block_bytes, size_ - read_)));
    ORO_CHECK(file_.read(read_, std::as_writable_bytes(std::span(block_))));
    read_ += block_.size();
    at_ = 0;
    return {};
}

Result<bool> TextLines::next(std::string& line) {
    line.clear();
    is_cut_ = false;
    bool is_any = false, is_ended = false;
    while (!is_ended) {
        if (at_ == block_.size()) {
            if (read_ == size_) break;
            ORO_CHECK(fill());
        }
        is_any = true;
        const std::size_t end = std::min(block_.find('\n', at_), block_.size());
        const std::size_t room = longest_text_line - line.size(), count = end - at_;
        is_cut_ |= count > room;
        line.append(block_, at_, std::min(count, room));
        is_ended = end < block_.size();
        at_ = end + (is_ended ? 1 : 0);
    }
    if (!is_any) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (++number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    return true;
}

}  // namespace oro
