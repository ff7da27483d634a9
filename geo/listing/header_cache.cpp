#include "geo/listing/header_cache.h"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/checksum.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"
#include "geo/listing/header_bytes.h"
#include "geo/sources/raster_parts.h"

namespace oro {
namespace {

constexpr std::string_view format = "orograph headers 2";

std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::string folder_of(const std::string& path) {
    return std::filesystem::path(path).parent_path().string();
}

std::uint64_t sum_of(std::string_view bytes) {
    return xxh64(std::as_bytes(std::span(bytes)));
}

template <class Bytes, class Entry>
void entry_fields(Bytes& bytes, Entry& entry) {
    auto& finding = entry.finding;
    bytes(finding.unfit.kind), bytes(finding.unfit.where), bytes(finding.unfit.what), bytes(finding.doubts);
    bytes(finding.companion);
}

void write_entry(ByteWriter& bytes, const HeaderEntry& entry) {
    bytes(entry.finding.source.has_value());
    if (entry.finding.source) header_fields(bytes, *entry.finding.source);
    entry_fields(bytes, entry);
    bytes(static_cast<std::uint64_t>(entry.states.size()));
    for (const auto& [path, state] : entry.states) bytes(path), bytes(state);
}

HeaderEntry read_entry(ByteReader& bytes) {
    HeaderEntry entry;
    bool has_source = false;
    bytes(has_source);
    if (has_source) header_fields(bytes, entry.finding.source.emplace());
    entry_fields(bytes, entry);
    std::uint64_t states = 0;
    bytes(states);
    for (; bytes.good && states > 0; --states) {
        auto& [path, state] = entry.states.emplace_back();
        bytes(path), bytes(state);
    }
    return entry;
}

}  // namespace

std::optional<FileState> settled_state(const std::string& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0) return std::nullopt;
    const FileState state{found.st_dev, found.st_ino, static_cast<std::uint64_t>(found.st_size),
                          nanoseconds(found.st_mtim), nanoseconds(found.st_ctim)};
    // Systems take times from a clock that steps every few milliseconds, or keep whole seconds.
    const std::int64_t last = std::max(state.modified_ns, state.changed_ns);
    const bool whole_seconds = state.changed_ns % 1'000'000'000 == 0;
    const std::int64_t step_ns = whole_seconds ? 2'500'000'000 : 50'000'000;
    const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
    if (now - last < step_ns) return std::nullopt;
    return state;
}

std::vector<std::pair<std::string, FileState>> HeaderCache::states_of(const std::vector<std::string>& files) {
    std::vector<std::string> paths = files;
    for (const std::string& file : files) paths.push_back(folder_of(file));
    std::ranges::sort(paths);
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    std::vector<std::pair<std::string, FileState>> states;
    for (const std::string& path : paths) {
        const auto state = settled_state(path);
        if (!state) return {};
        states.emplace_back(path, *state);
    }
    return states;
}

HeaderCache HeaderCache::read(const std::string& path, const std::string& stamp) {
    HeaderCache cache;
    std::error_code fault;
    if (path.empty() || !std::filesystem::is_regular_file(path, fault)) return cache;
    std::ifstream stream(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(stream), {}};
    std::uint64_t sum = 0;
    if (!stream.good() && !stream.eof()) return cache;
    if (all.size() < sizeof sum) return cache;
    const std::string_view body(all.data(), all.size() - sizeof sum);
    std::memcpy(&sum, all.data() + body.size(), sizeof sum);
    if (sum != sum_of(body)) return cache;
    ByteReader bytes(body);
    std::string its_format, its_stamp;
    std::uint64_t count = 0;
    bytes(its_format), bytes(its_stamp), bytes(count);
    if (!bytes.good || its_format != format || its_stamp != stamp) return cache;
    for (; bytes.good && count > 0; --count) {
        std::string file;
        bytes(file);
        HeaderEntry entry = read_entry(bytes);
        if (bytes.good) cache.entries_.emplace(std::move(file), std::move(entry));
    }
    if (!bytes.good) cache.entries_.clear();
    return cache;
}

std::optional<Finding> HeaderCache::find(const SourcePath& path) {
    const auto known = entries_.find(path.file);
    if (known == entries_.end() || known->second.states.empty()) return std::nullopt;
    for (const auto& [file, state] : known->second.states) {
        const auto [now, is_new] = states_.try_emplace(file);
        if (is_new) now->second = settled_state(file);
        if (now->second != state) return std::nullopt;
    }
    const HeaderEntry& entry = used_.insert(entries_.extract(known)).position->second;
    Finding finding = entry.finding;
    // How it was asked for is not the file's.
    if (finding.source) {
        finding.source->named = path.named;
        finding.source->report.path = path.shown;
    }
    return finding;
}

void HeaderCache::keep(const SourcePath& path, const Finding& finding,
                       const std::vector<std::pair<std::string, FileState>>& before) {
    const std::string own = local_file_of(path.file);
    const std::vector<std::string> files =
        finding.source ? finding.source->report.files : std::vector<std::string>{own};
    // What names other files, and is no source, may become one without being changed itself.
    if (!finding.source && lower_case(path.name).ends_with(".vrt")) return;
    // Words that name the file as it was asked for this time.
    if (!finding.doubts.empty() || (!finding.source && finding.unfit.what.empty())) return;
    const auto states = states_of(files);
    if (states.empty()) return;
    // Of its own file and folder both are known from before it was opened.
    for (const auto& state : before)
        if (std::ranges::find(states, state) == states.end()) return;
    if (before.empty()) return;
    used_[path.file] = {finding, states};
}

void HeaderCache::write(const std::string& path, const std::string& stamp) const {
    if (path.empty()) return;
    ByteWriter bytes;
    bytes(std::string(format)), bytes(stamp), bytes(static_cast<std::uint64_t>(used_.size()));
    for (const auto& [file, entry] : used_) {
        bytes(file);
        write_entry(bytes, entry);
    }
    bytes(sum_of(bytes.bytes));
    std::error_code ignored;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
    auto file = WholeFile::create(path, true);
    if (!file.ok() || !file->write(bytes.bytes.data(), bytes.bytes.size()).ok()) return;
    static_cast<void>(file->commit().ok());
}

}  // namespace oro
