#include "apps/batch/job_list.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "apps/options/horizon_options.h"
#include "apps/options/region_option_table.h"
#include "apps/report/json_fields.h"
#include "core/base/open_file.h"
#include "geo/files/letter_case.h"

namespace oro {
namespace {

using nlohmann::json;

// Commands that a line may give.
constexpr std::array batch_commands{"shot",  "panorama", "film",     "compare", "plan", "trade",  "sun",
                                    "sight", "profile",  "viewshed", "horizon", "bake", "export", "info"};
// Of these, options whose values are written.
constexpr std::array written_options{"--out", "--write-path", "--table"};
// Positional arguments, in the order of the command line.
constexpr std::array positional_names{"flight", "picture", "path", "paths"};

bool is_option_name(std::string_view name) {
    return !name.empty() &&
           std::ranges::all_of(name,
                               [](char c) {
                                   return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' ||
                                          c == '_';
                               }) &&
           name.front() != '-' && name.front() != '_';
}

std::string option_of(std::string name) {
    std::ranges::replace(name, '_', '-');
    return "--" + name;
}

std::string text_in(const json& value, const std::string& name) {
    if (value.is_number()) return value.dump();
    if (!value.is_string())
        throw JsonFault{"'" + name + "' must be a text, a number, true or false, or a list of them, and is " +
                        value.type_name()};
    auto text = value.get<std::string>();
    if (text.find('\0') != std::string::npos) throw JsonFault{"'" + name + "' holds a zero byte"};
    return text;
}

bool is_list_of_numbers(const json& value) {
    return value.is_array() && !value.empty() &&
           std::ranges::all_of(value, [](const json& one) { return one.is_number(); });
}

// Numbers with commas between them; of a size with an x.
std::string numbers_in(const json& list, const std::string& name) {
    std::string text;
    for (const json& one : list) text += (text.empty() ? "" : name == "size" ? "x" : ",") + one.dump();
    return text;
}

// The values that a name has: none of null and false.
std::vector<std::string> values_of(const json& value, const std::string& name) {
    if (is_list_of_numbers(value)) return {numbers_in(value, name)};
    if (!value.is_array()) return {text_in(value, name)};
    std::vector<std::string> values;
    for (const json& one : value)
        values.push_back(is_list_of_numbers(one) ? numbers_in(one, name) : text_in(one, name));
    if (values.empty()) throw JsonFault{"'" + name + "' is an empty list"};
    return values;
}

// A word that begins with a dash would be an option.
std::string as_path(std::string word) {
    return word.starts_with('-') ? "./" + word : word;
}

// The name and the value of each option among words, and what is none: name "".
std::vector<std::pair<std::string, std::string>> named_values(std::span<const std::string> words) {
    std::vector<std::pair<std::string, std::string>> all;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (!word.starts_with("--")) {
            all.emplace_back("", word);
            continue;
        }
        const std::size_t equals = word.find('=');
        if (equals != std::string::npos) {
            all.emplace_back(word.substr(0, equals), word.substr(equals + 1));
        } else if (i + 1 < words.size() && !words[i + 1].starts_with("--")) {
            all.emplace_back(word, words[++i]);
        } else {
            all.emplace_back(word, "");
        }
    }
    return all;
}

bool says_region(const std::string& option) {
    return std::ranges::any_of(region_option_table(), [&](const auto& row) { return row.name == option; });
}

// What follows from a job's words.
void read_words(BatchJob& job) {
    for (const auto& [option, value] : named_values(std::span(job.words).subspan(1))) {
        const bool is_written = std::ranges::find(written_options, option) != written_options.end();
        // With --at it writes a table, and no rasters.
        if (is_written && job.command == "horizon" && !lower_case(value).ends_with(".csv")) {
            const HorizonFiles files = horizon_files_of(value);
            job.writes.insert(job.writes.end(), {{option, files.horizon}, {option, files.sky_view}});
            continue;
        }
        if (is_written) {
            job.writes.push_back({option, value});
            continue;
        }
        if (!value.empty()) job.reads.push_back(value);
        if (option.empty() || option == "--view" || says_region(option))
            job.region += option + "=" + value + "\n";
    }
    if (!job.print.empty()) job.writes.push_back({"print", job.print});
}

std::string command_in(const json& object) {
    const std::string command = json_string(object, "command");
    if (std::ranges::find(batch_commands, command) != batch_commands.end()) return command;
    std::string all;
    for (const char* const one : batch_commands) all += std::string(all.empty() ? "" : ", ") + one;
    throw JsonFault{"\"" + command + "\" is no command that a line can give; these are " + all};
}

void add_positionals(const json& object, std::vector<std::string>& words) {
    for (const char* const name : positional_names) {
        const auto found = object.find(name);
        if (found == object.end() || found->is_null()) continue;
        for (std::string& value : values_of(*found, name)) words.push_back(as_path(std::move(value)));
    }
}

BatchJob job_of(const json& object, std::size_t line) {
    if (!object.is_object()) throw JsonFault{"must be a JSON object, as in {\"command\": \"shot\", ...}"};
    BatchJob job;
    job.line = line;
    job.command = command_in(object);
    job.words.push_back(job.command);
    add_positionals(object, job.words);
    for (const auto& [name, value] : object.items()) {
        const bool is_positional = std::ranges::find(positional_names, name) != positional_names.end();
        if (is_positional || name == "command" || name == "args" || value.is_null()) continue;
        if (!is_option_name(name)) throw JsonFault{"'" + name + "' is no name of an option"};
        if (name == "print") {
            job.print = text_in(value, name);
        } else if (value.is_boolean()) {
            if (value.get<bool>()) job.words.push_back(option_of(name));
        } else {
            for (const std::string& one : values_of(value, name))
                job.words.push_back(option_of(name) + "=" + one);
        }
    }
    if (object.contains("args"))
        for (std::string& word : json_strings(object, "args")) job.words.push_back(std::move(word));
    read_words(job);
    return job;
}

// Of an object that names something twice the parser would take the second.
void refuse_names_given_twice(const std::string& text) {
    std::set<std::string> names;
    std::string twice;
    const auto look = [&](int depth, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::key && depth == 1 &&
            !names.insert(parsed.get<std::string>()).second)
            twice = parsed.get<std::string>();
        return true;
    };
    const json parsed_again = json::parse(text, look);
    if (!parsed_again.is_null() && !twice.empty()) throw JsonFault{"'" + twice + "' is there twice"};
}

// Puts what a place has into all texts of a value. A text that names a file to be written takes no slashes of
// it.
void fill_in(json& value, const BatchPlace& place, bool is_file_name) {
    if (value.is_object()) {
        for (const auto& [name, field] : value.items())
            fill_in(field, place,
                    name == "out" || name == "print" || name == "table" || name == "write-path" ||
                        name == "write_path");
    } else if (value.is_array()) {
        for (json& one : value) fill_in(one, place, is_file_name);
    } else if (value.is_string()) {
        const Result<std::string> filled = with_fields(value.get<std::string>(), place, is_file_name);
        if (!filled.ok()) throw JsonFault{filled.error().what};
        value = *filled;
    }
}

Result<std::string> text_of_list(const std::string& file) {
    ORO_TRY(const OpenFile opened, OpenFile::open(file, OpenFile::Use::read_own));
    ORO_TRY(const std::uint64_t bytes, opened.size());
    if (bytes > most_list_bytes)
        return Error{ErrorKind::failed, file,
                     "has " + std::to_string(bytes) + " bytes; a list of jobs has at most 1 GiB: cut it"};
    std::string text(static_cast<std::size_t>(bytes), '\0');
    ORO_CHECK(opened.read(0, std::as_writable_bytes(std::span(text))));
    if (text.find('\0') != std::string::npos)
        return Error{ErrorKind::failed, file, "is no list of jobs: it is no text"};
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
    return text;
}

}  // namespace

BatchJob job_of_line(const std::string& text, std::size_t line, const BatchPlace* place) {
    const auto fault = [&](const std::string& what) {
        BatchJob job;
        job.line = line;
        job.fault = Error{ErrorKind::usage, "", what};
        return job;
    };
    if (text.size() > most_line_bytes) return fault("is longer than 1 MiB");
    BatchJob job;
    try {
        json object = parsed_json(text);
        refuse_names_given_twice(text);
        if (place != nullptr) fill_in(object, *place, false);
        job = job_of(object, line);
    } catch (const JsonFault& found) {
        job = fault(found.what);
    } catch (const json::exception& e) {
        job = fault(e.what());
    }
    if (place != nullptr) job.place = place->words();
    return job;
}

Result<std::vector<BatchJob>> read_jobs(const std::string& file, const std::vector<BatchPlace>& places) {
    ORO_TRY(const std::string text, text_of_list(file));
    std::vector<BatchJob> jobs;
    std::size_t line = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string one = text.substr(begin, end - begin);
        begin = end + 1;
        ++line;
        const std::size_t first = one.find_first_not_of(" \t\r");
        if (first == std::string::npos || one[first] == '#') continue;
        if (jobs.size() + std::max<std::size_t>(places.size(), 1) > most_jobs)
            return Error{ErrorKind::failed, file, "has more than 1,000,000 jobs: cut it"};
        for (const BatchPlace& place : places) jobs.push_back(job_of_line(one, line, &place));
        if (places.empty()) jobs.push_back(job_of_line(one, line));
    }
    if (jobs.empty()) return Error{ErrorKind::failed, file, "has no jobs: one JSON object a line"};
    if (std::ranges::all_of(jobs, [](const BatchJob& job) { return job.fault.has_value(); }))
        return Error{ErrorKind::failed, file,
                     "has no job that can be understood: line " + std::to_string(jobs.front().line) + " " +
                         jobs.front().fault->line()};
    return jobs;
}

}  // namespace oro
