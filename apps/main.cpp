// The program's door: prepares the process, runs its command line, and turns what no command foresaw into one
// line and an exit code.
#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "apps/commands/run_words.h"
#include "apps/output/interruption.h"
#include "core/base/files_read.h"
#include "geo/files/library_faults.h"
#include "geo/files/whole_file.h"

namespace {

// Where standard streams are closed, the next file opened would be taken for one, and messages written into
// it. Closed for writing is what standard output then stays.
void fill_standard_streams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) < 0 &&
            open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0)
            return;
    }
}

int reported_unforeseen(const char* what) {
    std::fprintf(stderr, "orograph: failed: %s\n", oro::one_line(what).c_str());
    return static_cast<int>(oro::ErrorKind::failed);
}

// Where memory or threads run out in a library that lets no exception pass, or it fails there for another
// reason (PROJ, when its database cannot be read any more), the program still ends in order. What is no
// exception of the library's is a programmer's mistake, and aborts.
[[noreturn]] void end_without_resources() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
        oro::end_out_of_memory();
    } catch (const std::exception& error) {
        oro::remove_unfinished_files();
        _exit(reported_unforeseen(error.what()));
    } catch (...) {
    }
    std::abort();
}

}  // namespace

int main(int argc, char** argv) {
    std::set_terminate(&end_without_resources);
    // A file that outgrows the shell's limit is a write that fails, and told as such.
    std::signal(SIGXFSZ, SIG_IGN);
    fill_standard_streams();
    oro::watch_libraries();
    // What was begun is undone on the way here: no half file stays.
    try {
        oro::remember_files_read();
        oro::clean_up_when_interrupted();
        return oro::run_words(argc, argv);
    } catch (const std::bad_alloc&) {
        return oro::tell_out_of_memory();
    } catch (const std::exception& error) {
        return reported_unforeseen(error.what());
    } catch (...) {
        return reported_unforeseen("for a reason that nobody told");
    }
}
