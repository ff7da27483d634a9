// What files said of themselves when they were last looked at, kept in a file: an entry counts only while all
// that it was read from is as it was.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "geo/files/source_paths.h"
#include "geo/sources/raster_source.h"

namespace oro {

// By which a file or a folder that was changed is told: also when its time was set back.
struct FileState {
    std::uint64_t device{}, inode{}, bytes{};
    std::int64_t modified_ns{}, changed_ns{};
    bool operator==(const FileState&) const = default;
};
// Nothing where there is none, and where it was changed so lately that the next change could leave the same
// times.
std::optional<FileState> settled_state(const std::string& path);

// The states of a file's parts and of the folders that these lie in (where side-cars may appear).
struct HeaderEntry {
    Finding finding;
    std::vector<std::pair<std::string, FileState>> states;
};

class HeaderCache {
  public:
    // `stamp`: whatever else an answer depends on (the program, what was told of files); other stamps have
    // other entries. A file that is not there, is damaged or of another stamp is an empty cache.
    static HeaderCache read(const std::string& path, const std::string& stamp);

    // What was found in a file, if nothing that it was found in has changed since.
    [[nodiscard]] std::optional<Finding> find(const SourcePath& path);
    // Keeps a finding, if all that it was found in is settled, and the same as before it was looked at.
    void keep(const SourcePath& path, const Finding& finding,
              const std::vector<std::pair<std::string, FileState>>& before);
    // All that was found or kept since read(). Whole or not at all; that it fails is nobody's loss.
    void write(const std::string& path, const std::string& stamp) const;

    // What a file is made of, as far as that is known before it is opened.
    static std::vector<std::pair<std::string, FileState>> states_of(const std::vector<std::string>& files);

  private:
    std::unordered_map<std::string, HeaderEntry> entries_, used_;
    std::unordered_map<std::string, std::optional<FileState>> states_;  // asked once a run
};

}  // namespace oro
