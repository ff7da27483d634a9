// Which file of a served folder an address names. Nothing outside the folder is ever named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace oro {

class ServedFolder {
  public:
    // A folder by its real path. Errors: it is not there, or is no folder.
    static Result<ServedFolder> of(const std::string& path);

    // The regular file that the path of an address ("/8/134/91.png", percent signs decoded) names, by its
    // real path: of a folder its index.html. Nothing where there is none, where the path or a link leads out
    // of the folder, or where a name in it begins with a point.
    [[nodiscard]] std::optional<std::filesystem::path> file_of(const std::string& address) const;
    // A page with the names in the folder that an address names, where that has no index.html. Nothing where
    // it is no folder of this one.
    [[nodiscard]] std::optional<std::string> listing_of(const std::string& address) const;
    [[nodiscard]] const std::filesystem::path& root() const { return root_; }

  private:
    [[nodiscard]] std::optional<std::filesystem::path> inside(const std::string& address) const;

    std::filesystem::path root_;
};

// What browsers call the kind of a file, by its ending: "image/png"; else "application/octet-stream".
std::string media_type_of(const std::filesystem::path& file);

}  // namespace oro
