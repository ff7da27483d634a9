// One job of a list: its words as a command line of its own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/batch/job_list.h"
#include "core/base/result.h"

namespace oro {

// What all jobs are told beside their own words.
struct JobSettings {
    bool overwrite{};
};

// That the command takes the job's words. Errors (usage): as the command line itself refuses them.
Result<void> check_job(const BatchJob& job);
// Runs it, quietly, and gives what it printed on standard output in `printed`, also where it failed; where
// the job names a file for that, it is written there instead once all went well. Nothing is thrown. Errors:
// the command's; no memory.
Result<void> run_job(const BatchJob& job, const JobSettings& settings, std::string& printed);

}  // namespace oro
