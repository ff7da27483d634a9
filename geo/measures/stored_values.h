// What a file stores, as far as it is read: so that people can hold it against what other programs say.
#pragma once

#include <optional>
#include <vector>

#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// The range of the values in all blocks that were read of one source.
class StoredValues {
  public:
    void add(const PostBlock& block);
    // Nothing where no value was read. rows, columns: of the whole file.
    [[nodiscard]] std::optional<StoredRange> range(int rows, int columns) const;

  private:
    std::vector<PostWindow> windows_;
    PostBlock seen_;
};

// Posts that lie in at least one of some windows.
[[nodiscard]] std::uint64_t posts_in(const std::vector<PostWindow>& windows);

}  // namespace oro
