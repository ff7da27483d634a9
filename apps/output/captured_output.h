// What a part of the program prints, caught before it reaches standard output.
#pragma once

#include <string>

#include "core/base/result.h"

namespace oro {

// While it is there, all that is written to standard output goes into a file without a name. Not two at a
// time, and not while threads print.
class CapturedOutput {
  public:
    // Errors: the system's.
    static Result<CapturedOutput> begin();
    CapturedOutput(CapturedOutput&& other) noexcept;
    CapturedOutput& operator=(CapturedOutput&&) = delete;
    CapturedOutput(const CapturedOutput&) = delete;
    CapturedOutput& operator=(const CapturedOutput&) = delete;
    // Standard output is again what it was.
    ~CapturedOutput();
    // Ends it, and gives what was printed. Errors: what was printed could not be kept.
    Result<std::string> end();

  private:
    CapturedOutput(int before, int kept) : before_(before), kept_(kept) {}
    // False where something of what was printed is lost.
    bool restore();

    int before_{-1};  // standard output's descriptor
    int kept_{-1};
};

}  // namespace oro
