#include "geo/files/kept_parts.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "geo/files/whole_file.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr const char* key_name = "tileset.key";
constexpr const char* part_ending = ".tile";

Result<std::vector<std::uint8_t>> bytes_of_part(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    if (!file.is_open() || file.bad()) return Error{ErrorKind::failed, path, "cannot be read"};
    return bytes;
}

// Without a name, or under a temporary one, until it is whole: a write that fails and a signal leave nothing.
Result<void> write_whole(const std::string& path, std::span<const std::uint8_t> bytes) {
    ORO_TRY(WholeFile file, WholeFile::create(path, true));
    ORO_CHECK(file.write(bytes.data(), bytes.size()));
    return file.commit_unsynced();
}

}  // namespace

std::string KeptParts::path_of(const std::string& name) const {
    return folder_ + "/" + name + part_ending;
}

Result<KeptParts> KeptParts::open(const std::string& folder, const std::string& key) {
    std::error_code failed;
    fs::create_directory(folder, failed);
    if (failed || !fs::is_directory(folder))
        return Error{ErrorKind::failed, folder, "cannot be made: " + failed.message()};
    const std::string path = folder + "/" + key_name;
    if (!fs::exists(path)) {
        if (!fs::is_empty(folder, failed))
            return Error{ErrorKind::failed, folder,
                         "holds something else than tiles of an export: move it away"};
        ORO_CHECK(write_whole(path, {reinterpret_cast<const std::uint8_t*>(key.data()), key.size()}));
    }
    ORO_TRY(const std::vector<std::uint8_t> known, bytes_of_part(path));
    if (std::string(known.begin(), known.end()) != key)
        return Error{ErrorKind::failed, folder,
                     "holds tiles of other data, options or another version of the program: remove it"};
    return KeptParts(folder);
}

bool KeptParts::has(const std::string& name) const {
    std::error_code ignored;
    return fs::exists(path_of(name), ignored);
}

Result<std::optional<std::vector<std::uint8_t>>> KeptParts::read(const std::string& name) const {
    using Read = std::optional<std::vector<std::uint8_t>>;
    if (!has(name)) return Read();
    ORO_TRY(std::vector<std::uint8_t> bytes, bytes_of_part(path_of(name)));
    return Read(std::move(bytes));
}

Result<void> KeptParts::write(const std::string& name, std::span<const std::uint8_t> bytes) const {
    return write_whole(path_of(name), bytes);
}

void KeptParts::remove() const {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder_, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        if (name == key_name || name.find(part_ending) != std::string::npos)
            fs::remove(entry->path(), ignored);
    }
    fs::remove(folder_, ignored);
}

}  // namespace oro
