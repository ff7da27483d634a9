#include "apps/batch/job_conflicts.h"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "geo/files/letter_case.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// Without links, from the root: weakly_canonical() leaves a name relative of which nothing is there.
fs::path whole_path(const std::string& name, std::error_code& failed) {
    const fs::path from_root = fs::absolute(name, failed);
    return failed ? fs::path(name) : fs::weakly_canonical(from_root, failed).lexically_normal();
}

// What a name leads to, the same for all names of one file.
class FileNames {
  public:
    const std::string& place_of(const std::string& name) {
        const auto known = places_.find(name);
        if (known != places_.end()) return known->second;
        struct stat found {};
        std::string place;
        if (stat(name.c_str(), &found) == 0) {
            place = std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino);
        } else {
            std::error_code failed;
            place = whole_path(name, failed).string();
            if (failed) place = name;
        }
        return places_.emplace(name, std::move(place)).first->second;
    }

  private:
    std::map<std::string, std::string> places_;
};

bool writes_into_folder(const BatchJob& job, const std::string& file) {
    return job.command == "film" && !lower_case(file).ends_with(".mp4") && file != job.print;
}

// Elevation data in a folder are found by their endings.
bool could_be_elevation(const std::string& file) {
    const std::string ending = lower_case(fs::path(file).extension().string());
    return ending == ".tif" || ending == ".tiff" || ending == ".oro" || ending == ".hgt";
}

std::string line_words(std::size_t line) {
    return "line " + std::to_string(line);
}

class Conflicts {
  public:
    Conflicts(const std::string& list, const std::vector<std::string>& spared,
              const std::vector<BatchJob>& jobs) {
        for (const std::string& file : spared) spared_.emplace(names_.place_of(file), list);
        for (const BatchJob& job : jobs) {
            if (job.fault) continue;
            for (const std::string& name : job.reads) take_input(job, name);
        }
    }

    // Nothing where a job may do what it shall.
    std::optional<Error> fault_of(const BatchJob& job) {
        std::set<std::string> own;
        for (const auto& [option, file] : job.writes) {
            const std::string named = option + " " + file;
            const auto fault = [&](const std::string& what) { return Error{ErrorKind::usage, named, what}; };
            const std::string& place = names_.place_of(file);
            if (spared_.contains(place)) return fault("would replace the list of jobs, or what it has of it");
            const auto reader = readers_.find(place);
            if (reader != readers_.end())
                return fault(reader->second == job.line
                                 ? "would replace what the job itself reads"
                                 : "is what " + line_words(reader->second) +
                                       " reads: lines do not wait for each other, so put that one into "
                                       "another list");
            if (const auto folder = folder_around(file))
                return fault("would be among the elevation data that " + line_words(*folder) +
                             " reads from its folder: write it elsewhere");
            if (!own.insert(place).second) return fault("is named twice");
            const auto [writer, is_first] = writers_.emplace(place, job.line);
            if (!is_first && !writes_into_folder(job, file))
                return fault("is what " + line_words(writer->second) + " writes");
        }
        return std::nullopt;
    }

  private:
    void take_input(const BatchJob& job, const std::string& name) {
        std::error_code ignored;
        readers_.emplace(names_.place_of(name), job.line);
        if (fs::is_directory(name, ignored)) folders_.emplace(names_.place_of(name), job.line);
    }

    // The line that reads a folder in which the file would be found as elevation data.
    std::optional<std::size_t> folder_around(const std::string& file) {
        if (folders_.empty() || !could_be_elevation(file)) return std::nullopt;
        std::error_code failed;
        fs::path folder = whole_path(file, failed).parent_path();
        while (!failed && !folder.empty()) {
            const auto found = folders_.find(names_.place_of(folder.string()));
            if (found != folders_.end()) return found->second;
            if (folder == folder.root_path()) break;
            folder = folder.parent_path();
        }
        return std::nullopt;
    }

    FileNames names_;
    std::map<std::string, std::string> spared_;
    std::map<std::string, std::size_t> readers_, folders_, writers_;  // lines, by place
};

}  // namespace

void find_conflicts(const std::string& list, const std::vector<std::string>& spared,
                    std::vector<BatchJob>& jobs) {
    Conflicts conflicts(list, spared, jobs);
    for (BatchJob& job : jobs)
        if (!job.fault) job.fault = conflicts.fault_of(job);
}

}  // namespace oro
