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

#include "core/base/files_read.h"

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

// A local file that GDAL reads.
class WatchedFile final : public VSIVirtualHandle {
  public:
    WatchedFile(VSIVirtualHandle* file, std::string name) : file_(file), name_(std::move(name)) {}

    int Seek(vsi_l_offset place, int whence) override {
        errno = 0;
        const int failed = file_->Seek(place, whence);
        if (failed != 0 && watching != nullptr && errno != 0 && errno != EINVAL)
            watching->note(name_ + ": cannot be read: " + words(errno));
        return failed;
    }
    vsi_l_offset Tell() override { return file_->Tell(); }
    std::size_t Read(void* to, std::size_t size, std::size_t count) override {
        if (watching != nullptr && watching->spent()) {
            note(watching->fault());
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
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    int Eof() override { return file_->Eof(); }
    int Close() override { return file_->Close(); }
    void* GetNativeFileDescriptor() override { return file_->GetNativeFileDescriptor(); }
    VSIRangeStatus GetRangeStatus(vsi_l_offset place, vsi_l_offset length) override {
        return file_->GetRangeStatus(place, length);
    }
    [[nodiscard]] bool HasPRead() const override { return false; }

  private:
    std::unique_ptr<VSIVirtualHandle> file_;
    std::string name_;
};

// The file system of this machine, as GDAL has it, for regular files.
class LocalFiles final : public VSIFilesystemHandler {
  public:
    explicit LocalFiles(VSIFilesystemHandler* files) : files_(files) {}

    VSIVirtualHandle* Open(const char* name, const char* access, bool set_error,
                           CSLConstList options) override {
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
        VSIVirtualHandle* const file = files_->Open(name, access, set_error, options);
        const int reason = errno;
        if (file == nullptr) {
            if (watching != nullptr && !is_absence(reason))
                watching->note(std::string(name) + ": cannot be opened: " + words(reason));
            errno = reason;
            return nullptr;
        }
        if (watching != nullptr)
            watching->opened(status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size));
        return new WatchedFile(file, name);
    }
    int Stat(const char* name, VSIStatBufL* status, int flags) override {
        return files_->Stat(name, status, flags);
    }
    int Unlink(const char* name) override { return files_->Unlink(name); }
    int Mkdir(const char* name, long mode) override { return files_->Mkdir(name, mode); }
    int Rmdir(const char* name) override { return files_->Rmdir(name); }
    int Rename(const char* from, const char* to) override { return files_->Rename(from, to); }
    char** ReadDirEx(const char* name, int most) override { return files_->ReadDirEx(name, most); }
    char** SiblingFiles(const char* name) override { return files_->SiblingFiles(name); }
    int IsCaseSensitive(const char* name) override { return files_->IsCaseSensitive(name); }
    GIntBig GetDiskFreeSpace(const char* name) override { return files_->GetDiskFreeSpace(name); }
    VSIDIR* OpenDir(const char* name, int depth, const char* const* options) override {
        return files_->OpenDir(name, depth, options);
    }

  private:
    std::unique_ptr<VSIFilesystemHandler> files_;
};

// A file system that terrain has no business with.
class RefusedFiles final : public VSIFilesystemHandler {
  public:
    explicit RefusedFiles(std::shared_ptr<VSIFilesystemHandler> before) : before_(std::move(before)) {}

    VSIVirtualHandle* Open(const char* name, const char*, bool, CSLConstList) override {
        refuse(name);
        return nullptr;
    }
    int Stat(const char* name, VSIStatBufL*, int) override {
        refuse(name);
        return -1;
    }
    bool IsLocal(const char*) override { return false; }
    bool SupportsRead(const char*) override { return false; }

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
    const CPLStringList prefixes(VSIFileManager::GetPrefixes());
    std::map<VSIFilesystemHandler*, std::shared_ptr<VSIFilesystemHandler>> before;  // some have two names
    for (int i = 0; i < prefixes.size(); ++i) {
        const std::string prefix = prefixes[i];
        if (std::ranges::find(allowed, prefix) != allowed.end()) continue;
        VSIFilesystemHandler* const handler = VSIFileManager::GetHandler(prefix.c_str());
        auto& kept = before[handler];
        if (!kept) kept.reset(handler);
        VSIFileManager::InstallHandler(prefix, new RefusedFiles(kept));
    }
    // The handler of names without a prefix.
    VSIFileManager::InstallHandler("", new LocalFiles(VSIFileManager::GetHandler("")));
    CPLHTTPSetFetchCallback(refuse_http, nullptr);
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
