#include "apps/output/captured_output.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <utility>

#include "core/base/open_file.h"

namespace oro {
namespace {

bool flush_all() {
    std::cout.flush();
    const bool flushed = std::fflush(stdout) == 0 && std::cout && std::ferror(stdout) == 0;
    return flushed;
}

Error output_fault(int why) {
    return {ErrorKind::failed, "standard output", "cannot be kept: " + system_reason(why)};
}

}  // namespace

Result<CapturedOutput> CapturedOutput::begin() {
    if (!flush_all()) return output_fault(EIO);
    const int before = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (before < 0) return output_fault(errno);
    const int kept = memfd_create("printed", MFD_CLOEXEC);
    if (kept < 0 || dup2(kept, STDOUT_FILENO) < 0) {
        const int why = errno;
        if (kept >= 0) close(kept);
        close(before);
        return output_fault(why);
    }
    return CapturedOutput(before, kept);
}

CapturedOutput::CapturedOutput(CapturedOutput&& other) noexcept
    : before_(std::exchange(other.before_, -1)), kept_(std::exchange(other.kept_, -1)) {}

bool CapturedOutput::restore() {
    if (before_ < 0) return true;
    const bool whole = flush_all();
    if (!whole) {
        std::clearerr(stdout);
        std::cout.clear();
    }
    dup2(before_, STDOUT_FILENO);
    close(std::exchange(before_, -1));
    return whole;
}

CapturedOutput::~CapturedOutput() {
    restore();
    if (kept_ >= 0) close(kept_);
}

Result<std::string> CapturedOutput::end() {
    if (!restore()) return output_fault(ENOSPC);
    const off_t bytes = lseek(kept_, 0, SEEK_END);
    if (bytes < 0) return output_fault(errno);
    std::string text(static_cast<std::size_t>(bytes), '\0');
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t count = pread(kept_, text.data() + at, text.size() - at, static_cast<off_t>(at));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return output_fault(count < 0 ? errno : EIO);
        at += static_cast<std::size_t>(count);
    }
    return text;
}

}  // namespace oro
