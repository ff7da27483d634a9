// The program under test with faults of the system let into it, and what must hold however it ends.
#pragma once

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace oro::test {

// Which call fails; see injection.h.
struct Fault {
    std::string calls;
    long number{0};
    long period{0};
    int error{5};
    bool own{false};

    [[nodiscard]] std::string line() const;
};

struct Disturbed {
    int exit_code{};  // 128 + signal
    bool timed_out{};
    long counted{};
    long failed{};
    long skipped{};
    std::string where;
    std::string out;
    std::string err;
};

// A command line of the program in a folder of its own, started once and forked for each run.
class DisturbedProgram {
  public:
    // `processors`: as many as the program shall think there are.
    DisturbedProgram(const std::vector<std::string>& words, std::filesystem::path folder, int processors);
    ~DisturbedProgram();
    DisturbedProgram(const DisturbedProgram&) = delete;
    DisturbedProgram& operator=(const DisturbedProgram&) = delete;

    Disturbed run(const Fault& fault);

  private:
    [[noreturn]] void become_server(const std::vector<std::string>& words, int in, int out,
                                    int processors) const;

    std::filesystem::path folder_;
    std::filesystem::path said_;
    pid_t server_{-1};
    std::FILE* plans_{nullptr};
    std::FILE* reports_{nullptr};
};

// A command that reads and writes files in its folder.
struct Command {
    std::string name;
    std::vector<std::string> words;
    std::map<std::string, std::string> inputs;  // name, bytes
    std::map<std::string, std::string> before;  // what the outputs held before: "" is no file
    bool goes_on{false};  // what was broken off may stay (.partial), and is gone on with
};

// Runs a command again and again, each time with another fault, and holds each run to this: it ends by
// itself; with exit 0 and the very result of an undisturbed run, or with another exit code, one line that
// says why, outputs as they were before (or, told of a fault that came after them, as they shall be: all of
// them alike) and nothing else in the folder.
class FaultRuns {
  public:
    FaultRuns(Command command, int processors);

    // How many calls there are to fail; a run tells it, the first time that it is asked.
    long count(const Fault& fault);
    // Tells what is wrong with how the run ended; "" when nothing is.
    std::string fault_of_run(const Fault& fault);
    // Runs that ended so, in the words of the summary.
    [[nodiscard]] long ended(const std::string& how) const;
    // One line: how many runs ended how.
    [[nodiscard]] std::string summary() const;

  private:
    void put_back();
    [[nodiscard]] std::map<std::string, std::string> files() const;
    std::string judge(const Disturbed& run, const Fault& fault);
    [[nodiscard]] bool outputs_are_old(const std::map<std::string, std::string>& there) const;
    std::string judge_success(const Disturbed& run, const std::map<std::string, std::string>& there) const;
    std::string judge_failure(const Disturbed& run, const std::map<std::string, std::string>& there) const;
    // Whether the undisturbed command makes of what is there what it would make of nothing.
    std::string judge_going_on();

    Command command_;
    std::filesystem::path folder_;
    DisturbedProgram program_;
    std::map<std::string, std::string> after_;  // the folder after an undisturbed run
    std::string out_;
    std::map<std::string, long> ends_;
    std::map<std::string, long> counts_;
};

// Runs a fault at places among all that there are: at each of the first `dense`, then at `sparse` of the
// rest, evenly and to the last. Failed expectations tell what was wrong; standard output gets the summary.
void expect_order(FaultRuns& runs, const Fault& kind, long dense, long sparse);

// Runs for each kind of fault: OROGRAPH_FAULTS, or few.
long runs_asked_for();

}  // namespace oro::test
