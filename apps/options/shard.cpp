#include "apps/options/shard.h"

#include <string_view>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"

namespace oro {

Result<Shard> parse_shard(const std::string& text) {
    Shard shard;
    if (text.empty()) return shard;
    const std::string_view all(text);
    const std::size_t slash = all.find('/');
    const auto read = [](std::string_view digits, std::int64_t& number) {
        return !digits.empty() && digits.front() >= '0' && digits.front() <= '9' &&
               read_whole(digits, number);
    };
    if (slash == std::string_view::npos || !read(all.substr(0, slash), shard.number) ||
        !read(all.substr(slash + 1), shard.count) || shard.number < 1 || shard.number > shard.count ||
        shard.count > most_shards)
        return refused("--shard", text, "must be NUMBER/COUNT, the number from 1 to the count: 2/4");
    return shard;
}

std::string shard_suffix(const Shard& shard) {
    return shard.is_whole() ? "" : "-" + std::to_string(shard.number) + "of" + std::to_string(shard.count);
}

}  // namespace oro
