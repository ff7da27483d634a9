// A command of this program that a window begins beside itself: a film, a map.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "apps/window/background_work.h"

namespace oro {

struct Viewer;

// What is to be begun.
struct CommandToBegin {
    std::string what;                // "the film"
    std::vector<std::string> words;  // after the program's name
    std::string out;                 // the file or folder that it writes
    std::string folder_of_frames;    // whose files tell how far it is; "": nothing does
    std::size_t frames{};            // that come there
};

// What goes on.
struct BegunCommand {
    std::string what;
    std::string out;
    bool has_share{};  // it is known how far it is
    // Gives what is told of it in the end.
    std::unique_ptr<BackgroundWork<std::string>> work{};
};

// Begins it in the working folder. One that goes on already is told, and stays. A window that is closed
// interrupts it.
void begin_command(Viewer& viewer, CommandToBegin command);
// Interrupts it. What it has written it keeps as the command says.
void stop_command(Viewer& viewer);
// Tells what became of it, once it is done.
void take_command(Viewer& viewer);
// "drawing the film, 42 %"; "" where none goes on.
std::string command_progress(const Viewer& viewer);

}  // namespace oro
