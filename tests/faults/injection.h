// A library that is loaded into the program before all others (LD_PRELOAD) and lets chosen calls fail: the
// n-th allocation, thread or system call since main() began.
//
//   FAULT="CALLS NUMBER PERIOD ERRNO WHOSE" LD_PRELOAD=libfault_injection.so orograph ...
//
// CALLS    allocation, or by:LIBRARY, those that this library makes itself; thread; system (all of those
//          below), or one of open read write lseek rename fsync close map truncate stat list
// NUMBER   the first that fails; 0 counts alone
// PERIOD   0: that one alone; 1: all from there on; k: each k-th from there on
// ERRNO    what a system call fails with (5: EIO)
// WHOSE    all, or own: calls that the program's own code makes, less those that libraries make
//
// Calls of Vulkan's drivers and their compilers are never counted: they end the process when one fails.
// With FAULT_SERVER=IN,OUT the program does not run: for each such line that comes in at descriptor IN it is
// forked where main() would begin, and what became of it goes to descriptor OUT as a line:
//
//   STATUS TIMED_OUT COUNTED FAILED SKIPPED WHERE
//
// STATUS is that of waitpid; SKIPPED are calls that would have failed but for a driver further out on the
// stack; WHERE are modules and offsets from the first call that failed outwards.
#pragma once

namespace oro::faults {

enum class Calls { none, allocation, thread, system };

struct Plan {
    Calls calls{Calls::none};
    char name[32]{};
    long number{0};
    long period{0};
    int error{0};
    bool own{false};
    char by[24]{};  // "", or the library whose own allocations alone are meant
};

// The plan that is in force; none before main().
const Plan& plan();

// Counts a call of this kind and says whether it is to fail.
bool must_fail(Calls calls, const void* caller);

// From now on the system calls that the plan names come to must_fail. False when the kernel does not let us.
bool watch_system_calls();

// Whose code an address is.
enum class Origin {
    program,
    library,
    driver,   // of Vulkan, and what it compiles shaders with
    neutral,  // of the C and C++ libraries and of this one: their callers count
};
// Of the innermost frame that is not neutral, from `caller` (or, if null, from here) outwards.
Origin origin_of_call(const void* caller);
// True for addresses in a library whose file's name begins so.
bool is_in(const char* library, const void* address);
// True when a driver is anywhere on the stack.
bool driver_on_stack();
// The stack as "module+offset module+offset ..." from the inside out.
void describe_stack(char* text, unsigned long size);

}  // namespace oro::faults
