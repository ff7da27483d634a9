// What stands between GDAL and the files that it opens: terrain files are data of strangers, and name other
// files. They reach no network and no pipe, and cost no more than they are given.
#pragma once

#include <chrono>
#include <cstdint>
#include <set>
#include <string>
#include <utility>

namespace oro {

// Lets GDAL open regular files of this machine, and what is packed in them (zip, tar, gzip, parts of files);
// every other file system of its (network, standard input, ...) refuses from now on, those that libraries add
// for themselves, too, and so does its HTTP client; but for those of a network, where they are allowed
// (network_paths.h). Once, after its drivers are registered.
void guard_files();

// Seconds in which a raster must have been opened, its side-cars and parts looked at.
inline constexpr double opening_limit_s = 30.0;
// Seconds in which a window of posts must have been read: a million posts a second, and these.
inline constexpr double reading_limit_s = 30.0;
// A file may be read so many times over while one window of posts is read (packed files are read again when
// they are read backwards), beside 256 MiB for all that is small.
inline constexpr std::uint64_t most_times_over = 64;

// Watches what GDAL reads on this thread while it lives. (Threads that GDAL starts itself are guarded, and
// not watched.) One at a time on a thread; an inner one takes over.
class FileWatch {
  public:
    explicit FileWatch(double limit_s);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    // The first thing that went wrong with a file and that GDAL may have passed over in silence: one that was
    // refused, one that the system could not open or read for another reason than that it is not there, time
    // or bytes that are spent. "" while nothing did.
    [[nodiscard]] const std::string& fault() const { return fault_; }
    // True when time or bytes are spent, which is a fault from then on.
    bool spent();

    // The one that watches this thread, or null.
    static FileWatch* innermost();
    // For the guard alone: what happens to files.
    void note(const std::string& what);
    void opened(std::uint64_t device, std::uint64_t inode, std::uint64_t bytes);
    void read(std::uint64_t bytes) { read_bytes_ += bytes; }

  private:
    FileWatch* outer_;
    double limit_s_;
    std::chrono::steady_clock::time_point end_;
    std::uint64_t allowed_bytes_{std::uint64_t{256} << 20U};
    std::uint64_t read_bytes_{0};
    std::set<std::pair<std::uint64_t, std::uint64_t>> seen_;
    std::string fault_;
};

}  // namespace oro
