#include "geo/files/network_files.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>

#include "core/base/open_file.h"
#include "geo/files/letter_case.h"
#include "geo/files/network_paths.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20U;

Error network_fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, without_keys(what)};
}

Result<void> check_allowed(const std::string& path) {
    if (!are_network_paths_allowed()) return network_path_refused(path);
    start_gdal();
    return {};
}

// The text before the last slash, and that after it.
std::pair<std::string, std::string> folder_and_name(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return {path.substr(0, slash), path.substr(slash + 1)};
}

std::string etag_of(const std::string& path) {
    const CPLStringList headers(VSIGetFileMetadata(path.c_str(), "HEADERS", nullptr), TRUE);
    for (int i = 0; i < headers.size(); ++i) {
        const std::string line = headers[i];
        const std::size_t equals = line.find_first_of("=:");
        if (equals != std::string::npos && lower_case(line.substr(0, equals)) == "etag")
            return line.substr(line.find_first_not_of(" ", equals + 1));
    }
    return {};
}

// What a server said against a request, in GDAL's words.
std::string last_words(const GdalMessages& messages, const std::string& otherwise) {
    const char* const of_vsi = VSIGetLastErrorMsg();
    return messages.last(of_vsi != nullptr && *of_vsi != '\0' ? of_vsi : otherwise);
}

// Of a file that could not be opened: that there is none, and not that the server would not say.
bool says_not_there(const std::string& words) {
    return VSIGetLastErrorNo() == VSIE_AWSObjectNotFound || words.find("404") != std::string::npos ||
           words.find("does not exist") != std::string::npos;
}

struct CloseNetworkFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using OpenNetworkFile = std::unique_ptr<VSILFILE, CloseNetworkFile>;

enum class Sent { all, not_read, not_taken };

// Sends all of a file, and leaves closing it to the caller: that is when it takes its name.
Sent send_bytes(int descriptor, std::uint64_t bytes, VSILFILE* to) {
    std::vector<char> block(block_bytes);
    for (std::uint64_t at = 0; at < bytes;) {
        const ssize_t got = pread(descriptor, block.data(), block.size(), static_cast<off_t>(at));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return Sent::not_read;
        const auto count = static_cast<std::size_t>(got);
        if (VSIFWriteL(block.data(), 1, count, to) != count) return Sent::not_taken;
        at += count;
    }
    return Sent::all;
}

Result<void> check_arrived(const std::string& path, std::uint64_t bytes) {
    ORO_TRY(const std::optional<NetworkFile> there, network_file(path));
    if (there && there->bytes == bytes) return {};
    return network_fault(
        path, "was sent, and the server has " +
                  (there ? std::to_string(there->bytes) + " of its " + std::to_string(bytes) + " bytes"
                         : std::string("no such file")));
}

}  // namespace

Result<std::optional<NetworkFile>> network_file(const std::string& path) {
    ORO_CHECK(check_allowed(path));
    const GdalMessages messages;
    VSIErrorReset();
    VSICurlPartialClearCache(path.c_str());
    // Not VSIStatExL: it tells a file that is not there and one that may not be asked about alike.
    const OpenNetworkFile opened(VSIFOpenExL(path.c_str(), "rb", TRUE));
    if (!opened) {
        const std::string words = last_words(messages, messages.warning());
        if (says_not_there(words)) return std::optional<NetworkFile>{};
        return network_fault(path, "cannot be asked about: " +
                                       (words.empty() ? std::string("the server does not answer") : words));
    }
    if (VSIFSeekL(opened.get(), 0, SEEK_END) != 0)
        return network_fault(path, "cannot be asked about: " + last_words(messages, "it has no size"));
    NetworkFile file{static_cast<std::uint64_t>(VSIFTellL(opened.get())), etag_of(path)};
    VSIStatBufL found{};
    if (file.version.empty() && VSIStatL(path.c_str(), &found) == 0)
        file.version = std::to_string(static_cast<std::int64_t>(found.st_mtime));
    return std::optional(std::move(file));
}

Result<void> check_network_target(const std::string& path, bool overwrite) {
    if (!are_network_paths_allowed()) return network_path_refused(path);
    if (!is_network_path_for_writing(path))
        return Error{ErrorKind::usage, path, "cannot be written: GDAL only reads such files"};
    const auto [folder, name] = folder_and_name(path);
    if (name.empty() || folder.find('/', 1) == std::string::npos)
        return Error{ErrorKind::usage, path, "names no file in a bucket, as in /vsis3/bucket/file"};
    if (overwrite) return {};
    ORO_TRY(const std::optional<NetworkFile> there, network_file(path));
    if (!there) return {};
    return network_fault(path, "exists already; allow overwriting, or choose another name");
}

Result<void> upload_file(int descriptor, const std::string& path) {
    ORO_CHECK(check_allowed(path));
    struct stat found {};
    if (fstat(descriptor, &found) != 0) return network_fault(path, "cannot be sent: " + system_reason(errno));
    const auto bytes = static_cast<std::uint64_t>(found.st_size);
    const GdalMessages messages;
    VSIErrorReset();
    OpenNetworkFile to(VSIFOpenExL(path.c_str(), "wb", TRUE));
    if (!to)
        return network_fault(path,
                             "cannot be written: " + last_words(messages, "the server takes no such file"));
    switch (send_bytes(descriptor, bytes, to.get())) {
        case Sent::all:
            break;
        case Sent::not_read: {
            const int why = errno;
            // Closing would give what was sent so far its name: the open file is left to the end of the
            // program.
            (void)to.release();
            return network_fault(path, "cannot be sent: " + system_reason(why != 0 ? why : EIO));
        }
        case Sent::not_taken:
            // GDAL gives up all parts when it closes a file of which one was refused.
            to.reset();
            return network_fault(path,
                                 "cannot be written: " + last_words(messages, "the server takes no more"));
    }
    if (VSIFCloseL(to.release()) != 0)
        return network_fault(path,
                             "cannot be written: " + last_words(messages, "the server did not take it"));
    return check_arrived(path, bytes);
}

Result<void> download_file(const std::string& path, int descriptor) {
    ORO_TRY(const std::optional<NetworkFile> there, network_file(path));
    if (!there) return network_fault(path, "is not there");
    const GdalMessages messages;
    const OpenNetworkFile from(VSIFOpenExL(path.c_str(), "rb", TRUE));
    if (!from)
        return network_fault(path, "cannot be read: " + last_words(messages, "the server does not give it"));
    std::vector<char> block(block_bytes);
    std::uint64_t at = 0;
    while (at < there->bytes) {
        const std::size_t got = VSIFReadL(block.data(), 1, block.size(), from.get());
        if (got == 0) break;
        for (std::size_t done = 0; done < got;) {
            const ssize_t put =
                pwrite(descriptor, block.data() + done, got - done, static_cast<off_t>(at + done));
            if (put < 0 && errno != EINTR)
                return network_fault(path, "cannot be kept: " + system_reason(errno));
            if (put > 0) done += static_cast<std::size_t>(put);
        }
        at += got;
    }
    if (at == there->bytes) return {};
    return network_fault(path, "cannot be read: " + last_words(messages, "it ended early"));
}

Result<void> remove_network_file(const std::string& path) {
    ORO_CHECK(check_allowed(path));
    const GdalMessages messages;
    VSIErrorReset();
    if (VSIUnlink(path.c_str()) == 0) return {};
    return network_fault(path, "cannot be removed: " + last_words(messages, "the server keeps it"));
}

Result<std::vector<std::string>> network_files_beside(const std::string& path) {
    ORO_CHECK(check_allowed(path));
    const auto [folder, name] = folder_and_name(path);
    const GdalMessages messages;
    VSICurlPartialClearCache(folder.c_str());
    const CPLStringList names(VSIReadDir(folder.c_str()), TRUE);
    if (names.size() == 0 && !messages.last("").empty())
        return network_fault(folder, "cannot be listed: " + messages.last(""));
    std::vector<std::string> beside;
    for (int i = 0; i < names.size(); ++i) {
        const std::string one = names[i];
        if (one.starts_with(name + ".")) beside.push_back(folder + "/" + one);
    }
    return beside;
}

}  // namespace oro
