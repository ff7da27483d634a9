// Another program that is run and waited for.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What goes on while a program runs.
struct ProgramWait {
    std::stop_token stop{};           // once it asks to stop, the program is interrupted (SIGINT)
    std::function<void()> each_turn;  // called every half second; may be empty
};

// Runs a program in a folder, with its standard input closed, and waits for its end. words[0] is the
// program's path, the others are its arguments; `folder` is absolute or relative to the working folder, "" is
// that one. Errors (failed): it cannot be started; it ended with another exit code than 0 or by a signal,
// with the last line that it printed; it was interrupted. From any thread.
Result<void> run_program(const std::string& folder, std::vector<std::string> words,
                         const ProgramWait& wait = {});

// The path of this program itself. Errors (failed): the system does not say it.
Result<std::string> own_program();

}  // namespace oro
