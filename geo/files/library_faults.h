// Faults that libraries keep to themselves: memory that ran out inside one of them, a database that could not
// be read. They go on as if something were not there, and what they then say may be wrong.
#pragma once

#include "core/base/result.h"

namespace oro {

// From now on such faults are remembered, and a fatal one of GDAL ends the program with one line instead of
// an abort. To be called before any library is used and any thread is started.
void watch_libraries();

// Errors: since watch_libraries() memory ran out somewhere in the process, or PROJ's database could not be
// read. What libraries have said until now is not to be relied on.
[[nodiscard]] Result<void> libraries_are_sound();

// For those who take GDAL's messages for themselves.
void note_gdal_message(bool is_fatal, bool for_want_of_memory) noexcept;

// While one lives, memory that its thread cannot have ends the program (end_out_of_memory()): for calls of
// libraries that never return after such a fault. PROJ 9.1 keeps its grids' mutex locked, and waits for it.
// Without watch_libraries() it does nothing.
class EndsWithoutMemory {
  public:
    EndsWithoutMemory();
    ~EndsWithoutMemory();
    EndsWithoutMemory(const EndsWithoutMemory&) = delete;
    EndsWithoutMemory& operator=(const EndsWithoutMemory&) = delete;
};

// Ends the program for want of memory: one line that was written before there was a want, unfinished files
// removed, exit code 1. Allocates nothing.
[[noreturn]] void end_out_of_memory() noexcept;
// Says that line alone, and gives the exit code.
int tell_out_of_memory() noexcept;

}  // namespace oro
