// Parts of an output that are done, in a folder beside it: what a command that was stopped goes on with, and
// what several machines share.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A file a part, NAME.tile, each there whole or not at all. May be used from several threads, and by several
// processes at once.
class KeptParts {
  public:
    // Makes the folder, or goes on with one that is there. key: a text that names all that the parts' bytes
    // depend on. Errors (failed): a folder of another key, or one that holds something else; what the system
    // says.
    static Result<KeptParts> open(const std::string& folder, const std::string& key);

    [[nodiscard]] bool has(const std::string& name) const;
    // Nothing where the part is not there. Errors (failed): what the system says.
    [[nodiscard]] Result<std::optional<std::vector<std::uint8_t>>> read(const std::string& name) const;
    [[nodiscard]] Result<void> write(const std::string& name, std::span<const std::uint8_t> bytes) const;
    // Where the part of that name is.
    [[nodiscard]] std::string path_of(const std::string& name) const;
    // Removes the parts and the folder; of a folder that holds something else that stays.
    void remove() const;

  private:
    explicit KeptParts(std::string folder) : folder_(std::move(folder)) {}

    std::string folder_;
};

}  // namespace oro
