#include "apps/baking/bake_place.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <span>
#include <system_error>

#include "apps/settings/user_folders.h"
#include "core/base/checksum.h"
#include "core/base/files_read.h"
#include "core/base/open_file.h"
#include "geo/files/letter_case.h"
#include "geo/files/network_files.h"
#include "geo/files/network_paths.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

std::string number_of(const std::string& text) {
    std::array<char, 20> number{};
    std::snprintf(number.data(), number.size(), "%016llx",
                  static_cast<unsigned long long>(xxh64(std::as_bytes(std::span(text)))));
    return number.data();
}

// What parts leave beside the file, and a bake that does all by itself does not.
bool is_of_parts(const std::string& file) {
    const std::string name = file.substr(file.rfind('/') + 1);
    return (name.find(".part-") != std::string::npos || name.find(".clusters.") != std::string::npos) &&
           !name.ends_with(".partial") && !name.ends_with(".partial-stitched");
}

Result<void> fetch_file(const std::string& from, const std::string& to) {
    ORO_TRY(WholeFile file, WholeFile::create(to, true));
    ORO_CHECK(download_file(from, fileno(file.stream())));
    return file.commit_own();
}

Result<void> send_file(const std::string& from, const std::string& to) {
    ORO_TRY(const OpenFile file, OpenFile::open(from, OpenFile::Use::read_own));
    return upload_file(file.descriptor(), to);
}

}  // namespace

Result<BakePlace> BakePlace::of(const std::string& out, bool overwrite) {
    BakePlace place;
    place.out_ = place.path_ = out;
    if (!is_network_path(out)) return place;
    if (!lower_case(out).ends_with(".oro"))
        return Error{ErrorKind::usage, "--out " + out, "the file's name must end in .oro"};
    ORO_CHECK(check_network_target(out, overwrite));
    ORO_TRY(const fs::path cache, user_cache_folder());
    const fs::path folder = cache / "baking" / number_of(out);
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) return Error{ErrorKind::failed, folder.string(), "cannot be made: " + failed.message()};
    place.path_ = (folder / fs::path(out).filename()).string();
    return place;
}

std::string BakePlace::shown(const std::string& file) const {
    return file.starts_with(path_) ? out_ + file.substr(path_.size()) : file;
}

Result<void> BakePlace::fetch_parts(const std::string& part) const {
    if (!is_on_network()) return {};
    ORO_TRY(const std::vector<std::string> there, network_files_beside(out_));
    for (const std::string& file : there) {
        if (!is_of_parts(file)) continue;
        const bool is_of_another =
            file.find(".part-") != std::string::npos && !file.ends_with(".part-" + part);
        if (!part.empty() && is_of_another) continue;
        ORO_CHECK(fetch_file(file, path_ + file.substr(out_.size())));
    }
    return {};
}

Result<void> BakePlace::send_parts() const {
    if (!is_on_network()) return {};
    std::error_code failed;
    const fs::path folder = fs::path(path_).parent_path();
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const std::string file = entry->path().string();
        if (file.starts_with(path_) && is_of_parts(file)) ORO_CHECK(send_file(file, shown(file)));
    }
    if (failed) return Error{ErrorKind::failed, folder.string(), "cannot be listed: " + failed.message()};
    clear();
    return {};
}

Result<void> BakePlace::send_baked() const {
    if (!is_on_network()) return {};
    if (const auto sent = send_file(path_, out_); !sent.ok())
        return Error{sent.error().kind, sent.error().where,
                     sent.error().what + "; what was baked is " + path_};
    ORO_TRY(const std::vector<std::string> there, network_files_beside(out_));
    for (const std::string& file : there)
        if (is_of_parts(file)) ORO_CHECK(remove_network_file(file));
    clear();
    return {};
}

void BakePlace::clear() const {
    std::error_code ignored;
    fs::remove_all(fs::path(path_).parent_path(), ignored);
}

}  // namespace oro
