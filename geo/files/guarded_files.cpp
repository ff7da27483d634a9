#include "geo/files/guarded_files.h"

#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/files_read.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

thread_local FileWatch* watching = nullptr;

void note(const std::string& what) {
    if (watching != nullptr) watching->note(what);
    CPLError(CE_Failure, CPLE_OpenFailed, "%s", what.c_str());
}

// A file that is not there, or a name that is none, is what GDAL asks about all the time.
bool is_absence(int reason) {
    return reason == 0 || reason == ENOENT || reason == ENOTDIR || reason == EISDIR || reason == ENAMETOOLONG;
}

std::string words(int reason) {
    return std::generic_category().message(reason);
}

// What GDAL's classes ask of those derived from them has changed from version to version, and the numbers of
// the versions are not looked at: each function is declared in every form that GDAL 3.6 to 3.12 asks for. The
// form that a version has overrides that version's; the others are functions that nothing calls. For that
// reason none is marked `override` here. A form that a version requires and that is missing makes the class
// abstract: that does not compile.
using OpenedFile = decltype(std::declval<VSIFilesystemHandler&>().Open("", "", false, nullptr));

// A handler's file, for the caller to own. GDAL up to 3.11 gives a pointer, GDAL 3.12 a std::unique_ptr.
[[maybe_unused]] VSIVirtualHandle* released(VSIVirtualHandle* file) {
    return file;
}
template <typename Deleter>
VSIVirtualHandle* released(std::unique_ptr<VSIVirtualHandle, Deleter> file) {
    return file.release();
}

// A local file that GDAL reads.
class WatchedFile final : public VSIVirtualHandle {
  public:
    WatchedFile(OpenedFile file, std::string name)
        : file_(released(std::move(file))), name_(std::move(name)) {}

    int Seek(vsi_l_offset place, int whence) {
        errno = 0;
        const int failed = file_->Seek(place, whence);
        if (failed != 0 && watching != nullptr && errno != 0 && errno != EINVAL)
            watching->note(name_ + ": cannot be read: " + words(errno));
        return failed;
    }
    vsi_l_offset Tell() { return file_->Tell(); }
    std::size_t Read(void* to, std::size_t size, std::size_t count) {
        if (watching != nullptr && watching->spent()) {
            note(watching->fault());
            refused_ = true;
            return 0;
        }
        errno = 0;
        const std::size_t got = file_->Read(to, size, count);
        const int reason = errno;
        if (watching != nullptr) {
            watching->read(got * size);
            if (got < count && reason != 0) watching->note(name_ + ": cannot be read: " + words(reason));
        }
        return got;
    }
    std::size_t Read(void* to, std::size_t bytes) { return Read(to, 1, bytes); }  // GDAL after 3.12
    std::size_t Write(const void*, std::size_t, std::size_t) { return 0; }
    std::size_t Write(const void*, std::size_t) { return 0; }  // GDAL after 3.12
    int Eof() { return file_->Eof(); }
    int Error() { return refused_ ? 1 : error_of(*file_); }  // GDAL 3.10
    void ClearErr() {                                        // GDAL 3.10
        refused_ = false;
        clear_error_of(*file_);
    }
    int Close() { return file_->Close(); }
    void* GetNativeFileDescriptor() { return file_->GetNativeFileDescriptor(); }
    VSIRangeStatus GetRangeStatus(vsi_l_offset place, vsi_l_offset length) {
        return file_->GetRangeStatus(place, length);
    }
    [[nodiscard]] bool HasPRead() const { return false; }

  private:
    // Up to GDAL 3.9 a file has no error of its own: a read that gives less than was asked for is the sign.
    template <typename File>
    static int error_of(File& file) {
        if constexpr (requires { file.Error(); }) {
            return file.Error();
        } else {
            return 0;
        }
    }
    template <typename File>
    static void clear_error_of(File& file) {
        if constexpr (requires { file.ClearErr(); }) file.ClearErr();
    }

    std::unique_ptr<VSIVirtualHandle> file_;
    std::string name_;
    bool refused_{};  // a read was refused: a limit of time or bytes is reached
};

// The file system of this machine, as GDAL has it, for regular files.
class LocalFiles final : public VSIFilesystemHandler {
  public:
    explicit LocalFiles(VSIFilesystemHandler* files) : files_(files) {}

    OpenedFile Open(const char* name, const char* access, bool set_error, CSLConstList options) {
        const std::string_view mode = access;
        if (mode.find_first_of("wa+") != std::string_view::npos)
            return files_->Open(name, access, set_error, options);
        struct stat status {};
        const bool there = stat(name, &status) == 0;
        if (there && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
            note(std::string(name) + ": is no regular file");
            errno = EINVAL;
            return nullptr;
        }
        // What a library writes for us it gets by its descriptor: an output, which it may read again.
        if (there && !std::string_view(name).starts_with("/proc/self/fd/")) remember_file_read(name, status);
        errno = 0;
        OpenedFile file = files_->Open(name, access, set_error, options);
        const int reason = errno;
        if (file == nullptr) {
            if (watching != nullptr && !is_absence(reason))
                watching->note(std::string(name) + ": cannot be opened: " + words(reason));
            errno = reason;
            return nullptr;
        }
        if (watching != nullptr)
            watching->opened(status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size));
        return OpenedFile(new WatchedFile(std::move(file), name));
    }
    int Stat(const char* name, VSIStatBufL* status, int flags) { return files_->Stat(name, status, flags); }
    int Unlink(const char* name) { return files_->Unlink(name); }
    int Mkdir(const char* name, long mode) { return files_->Mkdir(name, mode); }
    int Rmdir(const char* name) { return files_->Rmdir(name); }
    int Rename(const char* from, const char* to) { return renamed(*files_, from, to, nullptr, nullptr); }
    int Rename(const char* from, const char* to, GDALProgressFunc progress, void* of) {  // GDAL after 3.10
        return renamed(*files_, from, to, progress, of);
    }
    char** ReadDirEx(const char* name, int most) { return files_->ReadDirEx(name, most); }
    char** SiblingFiles(const char* name) { return files_->SiblingFiles(name); }
    int IsCaseSensitive(const char* name) { return files_->IsCaseSensitive(name); }
    GIntBig GetDiskFreeSpace(const char* name) { return files_->GetDiskFreeSpace(name); }
    VSIDIR* OpenDir(const char* name, int depth, const char* const* options) {
        return files_->OpenDir(name, depth, options);
    }

  private:
    template <typename Files>
    static int renamed(Files& files, const char* from, const char* to,
                       [[maybe_unused]] GDALProgressFunc progress, [[maybe_unused]] void* of) {
        if constexpr (requires { files.Rename(from, to, progress, of); }) {
            return files.Rename(from, to, progress, of);
        } else {
            return files.Rename(from, to);
        }
    }

    std::unique_ptr<VSIFilesystemHandler> files_;
};

// A file system that terrain has no business with.
class RefusedFiles final : public VSIFilesystemHandler {
  public:
    explicit RefusedFiles(std::shared_ptr<VSIFilesystemHandler> before) : before_(std::move(before)) {}

    OpenedFile Open(const char* name, const char*, bool, CSLConstList) {
        refuse(name);
        return nullptr;
    }
    int Stat(const char* name, VSIStatBufL*, int) {
        refuse(name);
        return -1;
    }
    bool IsLocal(const char*) { return false; }
    bool IsLocal(const char*) const { return false; }  // GDAL after 3.10
    bool SupportsRead(const char*) { return false; }

  private:
    static void refuse(const char* name) {
        note("names " + std::string(name) + ", which is no file on this machine: it is not opened");
        errno = EPERM;
    }

    std::shared_ptr<VSIFilesystemHandler> before_;  // kept, for GDAL may know it elsewhere
};

CPLHTTPResult* refuse_http(const char* address, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc,
                           void*, void*) {
    const std::string what =
        "names " + std::string(address) + ", which is no file on this machine: it is not opened";
    note(what);
    auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup(what.c_str());
    return result;
}

}  // namespace

void guard_files() {
    static constexpr std::array allowed{"/vsimem/", "/vsizip/", "/vsitar/", "/vsigzip/", "/vsisubfile/"};
    CPLStringList prefixes(VSIFileManager::GetPrefixes());
    prefixes.AddString("/vsicurl?");  // another name of /vsicurl/, which GDAL leaves out of its list
    std::map<VSIFilesystemHandler*, std::shared_ptr<VSIFilesystemHandler>> before;  // some have two names
    for (int i = 0; i < prefixes.size(); ++i) {
        const std::string prefix = prefixes[i];
        if (std::ranges::find(allowed, prefix) != allowed.end()) continue;
        if (are_network_paths_allowed() && is_network_path(prefix)) continue;
        VSIFilesystemHandler* const handler = VSIFileManager::GetHandler(prefix.c_str());
        auto& kept = before[handler];
        if (!kept) kept.reset(handler);
        VSIFileManager::InstallHandler(prefix, new RefusedFiles(kept));
    }
    // The handler of names without a prefix.
    VSIFileManager::InstallHandler("", new LocalFiles(VSIFileManager::GetHandler("")));
    if (!are_network_paths_allowed()) CPLHTTPSetFetchCallback(refuse_http, nullptr);
}

FileWatch::FileWatch(double limit_s)
    : outer_(watching),
      limit_s_(limit_s),
      end_(std::chrono::steady_clock::now() +
           std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * limit_s))) {
    watching = this;
}

FileWatch::~FileWatch() {
    watching = outer_;
}

FileWatch* FileWatch::innermost() {
    return watching;
}

void FileWatch::note(const std::string& what) {
    if (fault_.empty()) fault_ = what;
}

void FileWatch::opened(std::uint64_t device, std::uint64_t inode, std::uint64_t bytes) {
    constexpr std::uint64_t plenty = std::uint64_t{1} << 56U;
    if (seen_.insert({device, inode}).second)
        allowed_bytes_ =
            std::min(plenty, allowed_bytes_ + most_times_over * std::min(bytes, plenty / most_times_over));
}

bool FileWatch::spent() {
    if (std::chrono::steady_clock::now() > end_)
        note("takes more than " + std::to_string(std::lround(limit_s_)) +
             " s to read, which is the limit (unpack it, or convert it to a GeoTIFF)");
    else if (read_bytes_ > allowed_bytes_)
        note("its files are read more than " + std::to_string(most_times_over) +
             " times over, which is the limit (unpack it, or convert it to a GeoTIFF)");
    else
        return false;
    return true;
}

}  // namespace oro
