// The program's command line, from its words to its exit code.
#pragma once

namespace oro {

// Parses the words of main(), runs their command, and says on standard error what is wrong with either. Gives
// the exit code: 0, or that of the error's kind.
int run_words(int argc, char** argv);

}  // namespace oro
