// Jobs of one list that would get into each other's way.
#pragma once

#include <string>
#include <vector>

#include "apps/batch/job_list.h"

namespace oro {

// Jobs do not wait for each other, and machines that share a list do its parts at the same time. So a job
// gets a fault that would write what an earlier line writes, what any line reads, or into a folder of
// elevation data that another line reads, or one of the files `spared` (the list). Names are seen through to
// files (links, `..`). Several films may write frames into one folder. Gives the same whoever asks.
void find_conflicts(const std::string& list, const std::vector<std::string>& spared,
                    std::vector<BatchJob>& jobs);

}  // namespace oro
