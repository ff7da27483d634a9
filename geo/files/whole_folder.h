// Folders of many files that are there whole or not at all.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// A folder under a temporary name beside its real one, which it takes on commit(). Files are written into
// path(). Destroyed without commit, it is removed with all that it holds, and whatever had the name before is
// untouched. A program that is killed outright leaves it, by a name that begins with ".orograph-".
class WholeFolder {
  public:
    // An empty folder of the real name counts as none. Errors (failed): a file of that name; a folder that
    // holds something, when overwrite is false; a folder around it that cannot be written; a path
    // on a network (usage).
    static Result<WholeFolder> create(const std::string& path, bool overwrite);
    WholeFolder(WholeFolder&& other) noexcept;
    WholeFolder& operator=(WholeFolder&&) = delete;
    WholeFolder(const WholeFolder&) = delete;
    WholeFolder& operator=(const WholeFolder&) = delete;
    ~WholeFolder();

    // Where its files are written until commit().
    [[nodiscard]] const std::string& path() const { return temporary_; }
    // Puts all on the disk and takes the real name; a folder that had it before is removed after that. Errors
    // (failed): what the system says; a file that the program has read was changed meanwhile.
    Result<void> commit();

  private:
    WholeFolder() = default;
    void abandon() noexcept;
    [[nodiscard]] int take_name();

    std::string path_;
    std::string temporary_;
    bool overwrite_{false};
};

}  // namespace oro
