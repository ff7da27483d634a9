// The program with a Vulkan layer between it and its driver that makes calls fail
// (tests/faulty_vulkan/layer.cpp).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/apps/program.h"

namespace oro::test {

// What a run with the layer said, and what the layer saw.
struct FaultyRun {
    Outcome outcome;
    std::map<std::string, int> calls;   // that could fail, by name: how often
    int faults{};                       // calls that were made to fail
    std::vector<std::string> messages;  // of the validation layer, and objects that outlived their owner
    std::vector<std::string> files;     // that lie in the working folder after it
};

// Runs `words` in an empty folder. faults and devices: as ORO_FAULT and ORO_FAULT_DEVICES of the layer.
FaultyRun run_with_faults(const std::vector<std::string>& words, const std::string& faults,
                          const std::string& devices = "", const std::vector<std::string>& environment = {});

}  // namespace oro::test
