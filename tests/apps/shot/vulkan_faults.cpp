#include "tests/apps/shot/vulkan_faults.h"

#include <sstream>

#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;

FaultyRun run_with_faults(const std::vector<std::string>& words, const std::string& faults,
                          const std::string& devices, const std::vector<std::string>& environment) {
    const fs::path log = scratch_folder() / "calls";
    write_bytes(log, "");
    Circumstances there;
    there.folder = scratch_folder();
    there.environment = {"VK_ADD_LAYER_PATH=" OROGRAPH_FAULTY_VULKAN,
                         "VK_INSTANCE_LAYERS=VK_LAYER_OROGRAPH_faults",
                         "NODEVICE_SELECT=1",  // or Mesa's own layer sorts the devices that are made up
                         "OROGRAPH_VALIDATION=1",
                         "OROGRAPH_DEVICE",
                         "ORO_FAULT=" + faults,
                         "ORO_FAULT_DEVICES=" + devices,
                         "ORO_FAULT_LOG=" + log.string()};
    there.environment.insert(there.environment.end(), environment.begin(), environment.end());
    FaultyRun run;
    run.outcome = run_program(words, there);
    run.files = names_in(there.folder);
    std::istringstream lines(bytes_of(log));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = line.find(' ');
        const std::string kind = line.substr(0, space);
        if (kind == "call") {
            ++run.calls[line.substr(space + 1)];
        } else if (kind == "fault") {
            ++run.faults;
        } else {
            run.messages.push_back(line);
        }
    }
    return run;
}

}  // namespace oro::test
