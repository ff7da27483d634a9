#include "apps/interruption.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>

#include "geo/whole_file.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

// Kept to the very end of the program: a signal may come then, too.
struct ScratchFolders {
    std::mutex mutex;
    std::set<std::string> paths;
};
ScratchFolders& scratch_folders() {
    static auto* const all = new ScratchFolders;
    return *all;
}

void remove_scratch_folders() {
    const std::scoped_lock lock(scratch_folders().mutex);
    for (const std::string& path : scratch_folders().paths) {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
}

// A thread that does nothing but wait for a signal may do anything when it comes; a handler could not.
void wait_and_clean_up(sigset_t signals) {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) return;
    remove_unfinished_files();
    remove_scratch_folders();
    std::signal(signal, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    std::raise(signal);
}

}  // namespace

void clean_up_when_interrupted() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction current {};
        if (sigaction(signal, nullptr, &current) == 0 && current.sa_handler == SIG_DFL)
            sigaddset(&signals, signal);
    }
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    try {
        std::thread(wait_and_clean_up, signals).detach();
    } catch (const std::system_error&) {  // no thread to be had: the signals end the program at once
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    }
}

ScratchFolder::ScratchFolder() {
    std::error_code fault;
    const fs::path parent = fs::temp_directory_path(fault);
    path_ = ((fault ? fs::path("/tmp") : parent) / "orograph-XXXXXX").string();
    const std::scoped_lock lock(scratch_folders().mutex);
    made_ = mkdtemp(path_.data()) != nullptr;
    if (made_) scratch_folders().paths.insert(path_);
}

ScratchFolder::~ScratchFolder() {
    const std::scoped_lock lock(scratch_folders().mutex);
    std::error_code ignored;
    if (made_) fs::remove_all(path_, ignored);
    scratch_folders().paths.erase(path_);
}

}  // namespace oro
