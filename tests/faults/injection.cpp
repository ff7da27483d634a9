// Where main() would begin: takes the plan, or forks the program once for each plan that it is sent.
#include "tests/faults/injection.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace oro::faults {
namespace {

using Main = int (*)(int, char**, char**);

// What the server and the program it has forked both see.
struct Report {
    std::atomic<long> counted;
    std::atomic<long> failed;
    std::atomic<long> skipped;
    char where[1800];
};

struct State {
    Main real_main{nullptr};
    Plan plan;
    std::atomic<bool> armed{false};
    Report* report{nullptr};
};
State& state() {
    static State only;
    return only;
}

// Set while this library works, so that what it does itself is not counted.
thread_local bool inside = false;

constexpr double longest_run_s = 60.0;

bool parse_plan(const char* text, Plan& plan) {
    char whose[8] = "";
    plan = {};
    if (std::sscanf(text, "%31s %ld %ld %d %7s", plan.name, &plan.number, &plan.period, &plan.error, whose) <
        2)
        return false;
    plan.own = std::strcmp(whose, "own") == 0;
    if (std::sscanf(plan.name, "by:%23s", plan.by) == 1 || std::strcmp(plan.name, "allocation") == 0) {
        plan.calls = Calls::allocation;
    } else if (std::strcmp(plan.name, "thread") == 0) {
        plan.calls = Calls::thread;
    } else {
        plan.calls = Calls::system;
    }
    return true;
}

void arm(const Plan& plan) {
    state().plan = plan;
    if (plan.calls == Calls::system && !watch_system_calls()) {
        std::fputs("fault injection: system calls cannot be watched here\n", stderr);
        _exit(125);
    }
    state().armed = true;
}

// Waits for a child; kills it when it takes too long. True when it had to.
bool wait_for(pid_t child, int& status) {
    for (double waited_s = 0.0;;) {
        if (waitpid(child, &status, WNOHANG) == child) return false;
        if (waited_s > longest_run_s) break;
        const double nap_s = waited_s < 0.5 ? 0.0005 : 0.01;
        const timespec nap{0, static_cast<long>(nap_s * 1e9)};
        nanosleep(&nap, nullptr);
        waited_s += nap_s;
    }
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return true;
}

int serve(int in, int out, int argc, char** argv, char** environment) {
    FILE* const plans = fdopen(in, "r");
    FILE* const reports = fdopen(out, "w");
    char line[200];
    while (plans && reports && std::fgets(line, sizeof line, plans)) {
        Plan plan;
        if (!parse_plan(line, plan)) return 125;
        Report& report = *state().report;
        report.counted = report.failed = report.skipped = 0;
        report.where[0] = '\0';
        const pid_t child = fork();
        if (child < 0) return 125;
        if (child == 0) {
            close(in);
            close(out);
            arm(plan);
            std::exit(state().real_main(argc, argv, environment));
        }
        int status = 0;
        const bool timed_out = wait_for(child, status);
        std::fprintf(reports, "%d %d %ld %ld %ld %s\n", status, timed_out ? 1 : 0, report.counted.load(),
                     report.failed.load(), report.skipped.load(), report.where);
        std::fflush(reports);
    }
    return 0;
}

int main_with_faults(int argc, char** argv, char** environment) {
    void* const shared =
        mmap(nullptr, sizeof(Report), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (shared == MAP_FAILED) return 125;
    state().report = new (shared) Report{};
    unsetenv("LD_PRELOAD");  // not for programs that this one starts
    if (const char* server = std::getenv("FAULT_SERVER")) {
        int in = -1, out = -1;
        if (std::sscanf(server, "%d,%d", &in, &out) != 2) return 125;
        unsetenv("FAULT_SERVER");
        return serve(in, out, argc, argv, environment);
    }
    Plan plan;
    if (const char* text = std::getenv("FAULT"); text && parse_plan(text, plan)) arm(plan);
    return state().real_main(argc, argv, environment);
}

}  // namespace

const Plan& plan() {
    return state().plan;
}

bool must_fail(Calls calls, const void* caller) {
    if (inside || !state().armed || state().plan.calls != calls) return false;
    if (const char* const library = state().plan.by; *library != '\0' && !is_in(library, caller))
        return false;
    inside = true;
    const int error_number = errno;
    const Plan& plan = state().plan;
    Report& report = *state().report;
    bool fails = false;
    const Origin origin = origin_of_call(caller);
    if (origin == Origin::program || (origin == Origin::library && !plan.own)) {
        const long number = ++report.counted;
        fails = plan.number > 0 && (number == plan.number || (plan.period > 0 && number > plan.number &&
                                                              (number - plan.number) % plan.period == 0));
        if (fails && driver_on_stack()) {
            fails = false;
            ++report.skipped;
        }
        if (fails && report.failed++ == 0) describe_stack(report.where, sizeof report.where);
    }
    errno = error_number;
    inside = false;
    return fails;
}

}  // namespace oro::faults

extern "C" int __libc_start_main(int (*real_main)(int, char**, char**), int argc, char** argv, int (*init)(),
                                 void (*fini)(), void (*rtld_fini)(), void* stack_end) {
    using Start =
        int (*)(int (*)(int, char**, char**), int, char**, int (*)(), void (*)(), void (*)(), void*);
    const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
    oro::faults::state().real_main = real_main;
    return start(&oro::faults::main_with_faults, argc, argv, init, fini, rtld_fini, stack_end);
}
