// What a signal that ends the program must not leave behind.
#pragma once

#include <string>

namespace oro {

// From now on SIGINT, SIGTERM and SIGHUP take unfinished files and scratch folders with them before they end
// the program as they always do. Ignored ones stay ignored (nohup). To be called before any thread is
// started.
void clean_up_when_interrupted();

// A folder of its own for passing files, in the system's folder for such; it goes when its owner goes or when
// the program is interrupted.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    // False when it could not be made; path() then names what was tried.
    [[nodiscard]] bool made() const { return made_; }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
    bool made_{false};
};

}  // namespace oro
