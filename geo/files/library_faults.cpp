#include "geo/files/library_faults.h"

#include <cpl_error.h>
#include <sqlite3.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <new>
#include <string_view>

#include "geo/files/whole_file.h"

namespace oro {
namespace {

std::atomic<bool> memory_ran_out{false};
std::atomic<bool> database_failed{false};
thread_local int calls_that_hang = 0;

void on_failed_allocation() {
    memory_ran_out = true;
    if (calls_that_hang > 0) end_out_of_memory();
    throw std::bad_alloc();
}

// What SQLite, in which PROJ keeps its database, says of its own faults. An error code, that is all PROJ
// gets, too, and takes for "no such thing".
void on_database_report(void*, int code, const char*) {
    const int kind = code & 0xff;
    if (kind == SQLITE_NOMEM) memory_ran_out = true;
    if (kind == SQLITE_IOERR || kind == SQLITE_CORRUPT || kind == SQLITE_NOTADB) database_failed = true;
}

void write_all(std::string_view text) noexcept {
    while (!text.empty()) {
        const ssize_t count = write(STDERR_FILENO, text.data(), text.size());
        if (count <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(count));
    }
}

}  // namespace

void note_gdal_message(bool is_fatal, bool for_want_of_memory) noexcept {
    if (is_fatal) end_out_of_memory();
    if (for_want_of_memory) memory_ran_out = true;
}

namespace {

// What GDAL says where none of our own handlers listens. It aborts after a fatal error: its small allocations
// have no other way to fail.
void CPL_STDCALL on_gdal_message(CPLErr severity, CPLErrorNum number, const char* message) {
    note_gdal_message(severity == CE_Fatal, number == CPLE_OutOfMemory);
    if (number != CPLE_OutOfMemory) CPLDefaultErrorHandler(severity, number, message);
}

// Libraries abort where a small allocation fails (assertions of PROJ, GDAL's last resort). Once memory has
// run out that is the reason, and the program ends in order; every other abort stays one.
void on_abort(int) {
    if (memory_ran_out) end_out_of_memory();
}

}  // namespace

void watch_libraries() {
    (void)std::signal(SIGABRT, &on_abort);
    std::set_new_handler(&on_failed_allocation);
    (void)sqlite3_config(SQLITE_CONFIG_LOG, &on_database_report, nullptr);
    CPLSetErrorHandler(&on_gdal_message);
}

Result<void> libraries_are_sound() {
    if (memory_ran_out)
        return Error{ErrorKind::failed, "memory",
                     "there was not enough of it, and what was read may lack something"};
    if (database_failed)
        return Error{ErrorKind::failed, "PROJ's database (proj.db)",
                     "could not be read to its end; what PROJ says may be wrong"};
    return {};
}

EndsWithoutMemory::EndsWithoutMemory() {
    ++calls_that_hang;
}

EndsWithoutMemory::~EndsWithoutMemory() {
    --calls_that_hang;
}

int tell_out_of_memory() noexcept {
    write_all(
        "orograph: memory: there is not enough of it for this; a smaller --size or region needs less\n");
    return static_cast<int>(ErrorKind::failed);
}

void end_out_of_memory() noexcept {
    // What ends the program may itself want memory, and come here again.
    static std::atomic_flag is_ending = ATOMIC_FLAG_INIT;
    if (!is_ending.test_and_set()) remove_unfinished_files();
    _exit(tell_out_of_memory());
}

}  // namespace oro
