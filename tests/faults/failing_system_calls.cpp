// System calls that fail by plan, whichever library makes them: the kernel is asked (seccomp) to send a
// signal in their place, whose handler makes the call from the one place that is exempt, or fails it.
#include <csignal>

#include "tests/faults/injection.h"

#if defined(__x86_64__)

#include <dlfcn.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

extern "C" long fault_injection_gate(long number, long a, long b, long c, long d, long e, long f);
extern "C" const char fault_injection_gate_end;
asm(R"(
    .text
    .globl fault_injection_gate
    .hidden fault_injection_gate
    .globl fault_injection_gate_end
    .hidden fault_injection_gate_end
fault_injection_gate:
    mov %rdi, %rax
    mov %rsi, %rdi
    mov %rdx, %rsi
    mov %rcx, %rdx
    mov %r8, %r10
    mov %r9, %r8
    mov 8(%rsp), %r9
    syscall
fault_injection_gate_end:
    ret
)");

namespace oro::faults {
namespace {

struct Watched {
    const char* name;
    int number;
};
constexpr Watched watched[] = {
    {"open", SYS_open},          {"open", SYS_openat},      {"read", SYS_read},       {"read", SYS_pread64},
    {"read", SYS_readv},         {"read", SYS_preadv},      {"write", SYS_write},     {"write", SYS_pwrite64},
    {"write", SYS_writev},       {"write", SYS_pwritev},    {"lseek", SYS_lseek},     {"rename", SYS_rename},
    {"rename", SYS_renameat},    {"rename", SYS_renameat2}, {"rename", SYS_link},     {"rename", SYS_linkat},
    {"fsync", SYS_fsync},        {"fsync", SYS_fdatasync},  {"close", SYS_close},     {"map", SYS_mmap},
    {"truncate", SYS_ftruncate}, {"stat", SYS_stat},        {"stat", SYS_lstat},      {"stat", SYS_fstat},
    {"stat", SYS_newfstatat},    {"stat", SYS_statx},       {"list", SYS_getdents64},
};

void on_system_call(int, siginfo_t*, void* context) {
    greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
    const long number = registers[REG_RAX];
    const bool standard_error =
        (number == SYS_write || number == SYS_writev) && registers[REG_RDI] == 2;  // where faults are told
    const bool fails = !standard_error && must_fail(Calls::system, nullptr);
    // A close that fails has closed all the same.
    if (!fails || number == SYS_close) {
        registers[REG_RAX] =
            fault_injection_gate(number, registers[REG_RDI], registers[REG_RSI], registers[REG_RDX],
                                 registers[REG_R10], registers[REG_R8], registers[REG_R9]);
    }
    if (fails) registers[REG_RAX] = -(plan().error > 0 ? plan().error : EIO);
}

}  // namespace

bool watch_system_calls() {
    struct sigaction action {};
    action.sa_sigaction = &on_system_call;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_RESTART;
    if (sigaction(SIGSYS, &action, nullptr) != 0) return false;
    sock_filter filter[4 * sizeof watched / sizeof *watched + 16];
    unsigned short length = 0;
    const auto add = [&](std::uint16_t code, std::uint8_t if_true, std::uint8_t if_false,
                         std::uint32_t value) {
        filter[length++] = {code, if_true, if_false, value};
    };
    const auto gate = reinterpret_cast<std::uint64_t>(&fault_injection_gate_end);
    constexpr std::uint16_t load = BPF_LD | BPF_W | BPF_ABS, equal = BPF_JMP | BPF_JEQ | BPF_K,
                            verdict = BPF_RET | BPF_K;
    add(load, 0, 0, offsetof(seccomp_data, instruction_pointer));
    add(equal, 0, 3, static_cast<std::uint32_t>(gate));
    add(load, 0, 0, offsetof(seccomp_data, instruction_pointer) + 4);
    add(equal, 0, 1, static_cast<std::uint32_t>(gate >> 32));
    add(verdict, 0, 0, SECCOMP_RET_ALLOW);
    for (const Watched& call : watched) {
        if (std::strcmp(plan().name, "system") != 0 && std::strcmp(plan().name, call.name) != 0) continue;
        const bool maps = call.number == SYS_mmap;  // of a file; memory without one is malloc's
        add(load, 0, 0, offsetof(seccomp_data, nr));
        add(equal, 0, maps ? 3 : 1, static_cast<std::uint32_t>(call.number));
        if (maps) {
            add(load, 0, 0, offsetof(seccomp_data, args[4]));
            add(equal, 1, 0, 0xffffffffU);
        }
        add(verdict, 0, 0, SECCOMP_RET_TRAP);
    }
    add(verdict, 0, 0, SECCOMP_RET_ALLOW);
    const sock_fprog program{length, filter};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace oro::faults

// A thread that blocks the signal would be killed by it.
extern "C" int pthread_sigmask(int how, const sigset_t* signals, sigset_t* old) noexcept {
    using Mask = int (*)(int, const sigset_t*, sigset_t*);
    static const auto mask = reinterpret_cast<Mask>(dlsym(RTLD_NEXT, "pthread_sigmask"));
    if (!signals || how == SIG_UNBLOCK) return mask(how, signals, old);
    sigset_t less = *signals;
    sigdelset(&less, SIGSYS);
    return mask(how, &less, old);
}

#else

bool oro::faults::watch_system_calls() {
    return false;
}

#endif
