#include "apps/output/interruption.h"

#include <csignal>
#include <system_error>
#include <thread>

#include "geo/files/temporary_file.h"

namespace oro {
namespace {

void end_by(int signal) {
    remove_unfinished_files();
    std::signal(signal, SIG_DFL);
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, signal);
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
    std::raise(signal);
}

// A thread that does nothing but wait for a signal may do anything when it comes; a handler could not.
void wait_and_clean_up(sigset_t signals) {
    int signal = 0;
    if (sigwait(&signals, &signal) != 0) return;
    end_by(signal);
}

}  // namespace

void clean_up_when_interrupted() {
    sigset_t signals;
    sigemptyset(&signals);
    // SIGPIPE from a write stays with the thread that wrote, and pends there: the write fails with EPIPE.
    // SIGXFSZ is ignored (core/base/file_target.h): such a write fails, too.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU,
                             SIGVTALRM, SIGPROF, SIGIO, SIGPWR, SIGSTKFLT}) {
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

void end_if_reader_has_gone() {
    sigset_t pending;
    if (sigpending(&pending) == 0 && sigismember(&pending, SIGPIPE) == 1) end_by(SIGPIPE);
}

}  // namespace oro
