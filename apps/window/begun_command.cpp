#include "apps/window/begun_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/output/child_process.h"
#include "apps/window/viewer.h"

namespace oro {
namespace {

std::size_t files_in(const std::string& folder) {
    std::error_code fault;
    std::size_t count = 0;
    for (std::filesystem::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault))
        ++count;
    return count;
}

}  // namespace

void begin_command(Viewer& viewer, CommandToBegin command) {
    BegunCommand& begun = viewer.begun;
    if (begun.work) return tell(viewer, begun.what + " is being drawn still");
    auto program = own_program();
    if (!program.ok()) return tell(viewer, program.error());
    command.words.insert(command.words.begin(), *program);
    begun.what = command.what;
    begun.out = command.out;
    begun.has_share = command.frames > 0;
    tell(viewer, "draws " + command.what + " into " + command.out + "; the window goes on meanwhile");
    begun.work = std::make_unique<BackgroundWork<std::string>>(
        [command = std::move(command)](const auto& tell_share,
                                       const std::stop_token& stop) -> Result<std::string> {
            ProgramWait wait;
            wait.stop = stop;
            if (command.frames > 0) {
                wait.each_turn = [&] {
                    tell_share(static_cast<double>(files_in(command.folder_of_frames)) /
                               static_cast<double>(command.frames));
                };
            }
            ORO_CHECK(run_program("", command.words, wait));
            return written_words(command.out);
        });
}

void stop_command(Viewer& viewer) {
    if (viewer.begun.work) viewer.begun.work->stop();
}

void take_command(Viewer& viewer) {
    auto& work = viewer.begun.work;
    if (!work || !work->ready()) return;
    const auto done = std::exchange(work, nullptr);
    const Result<std::string> said = done->take();
    if (said.ok()) return tell(viewer, *said);
    if (done->is_stopped()) return tell(viewer, viewer.begun.what + " was stopped");
    tell(viewer, viewer.begun.what + " was not drawn: " + said.error().what, true);
}

std::string command_progress(const Viewer& viewer) {
    const BegunCommand& begun = viewer.begun;
    if (!begun.work) return "";
    if (!begun.has_share) return "drawing " + begun.what;
    char text[80];
    std::snprintf(text, sizeof text, ", %.0f %%", std::floor(100.0 * std::min(1.0, begun.work->share())));
    return "drawing " + begun.what + text;
}

}  // namespace oro
