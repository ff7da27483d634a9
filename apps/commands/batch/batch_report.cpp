#include "apps/commands/batch/batch_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/report/figures.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"

namespace oro {
namespace {

const char* name_of(LineState state) {
    switch (state) {
        case LineState::done:
            return "done";
        case LineState::kept:
            return "kept";
        case LineState::failed:
            return "failed";
        case LineState::to_do:
            break;
    }
    return "to do";
}

// What a command printed: an object where it is JSON, else text.
nlohmann::ordered_json printed_json(const std::string& text) {
    auto parsed = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!parsed.is_discarded()) return parsed;
    return text;
}

nlohmann::ordered_json line_json(const LineReport& line) {
    nlohmann::ordered_json json = json_object("line", line.line, "command", line.command, "state",
                                              name_of(line.state), "seconds", line.seconds);
    if (!line.place.empty()) json["place"] = line.place;
    json["files"] = nlohmann::ordered_json::array();
    for (const WrittenByJob& file : line.written) json["files"].push_back(path_json(file.path));
    if (line.error)
        json["error"] =
            json_object("exit_code", static_cast<int>(line.error->kind), "message", line.error->line());
    if (!line.printed.empty()) json["printed"] = printed_json(line.printed);
    return json;
}

nlohmann::ordered_json report_json(const BatchOptions& options, const BatchReport& report) {
    nlohmann::ordered_json json = json_object("jobs", path_json(options.jobs));
    json["shard"] = json_object("number", report.shard.number, "count", report.shard.count);
    json["lines"] =
        json_object("of_the_list", report.lines_of_list, "of_the_shard", report.lines.size(), "done",
                    report.count(LineState::done), "kept", report.count(LineState::kept), "failed",
                    report.count(LineState::failed), "to_do", report.count(LineState::to_do));
    json["regions_opened"] = report.regions_read;
    json["times_s"] = json_object("all", report.seconds);
    json["each"] = nlohmann::ordered_json::array();
    for (const LineReport& line : report.lines) json["each"].push_back(line_json(line));
    return json;
}

std::string lines_words(std::size_t count) {
    return counted(count, "line", "lines");
}

std::string sentence_of(const BatchReport& report) {
    const std::size_t kept = report.count(LineState::kept), failed = report.count(LineState::failed);
    std::string text = lines_words(report.count(LineState::done)) + " done";
    if (kept > 0) text += ", " + grouped(kept) + (kept == 1 ? " was" : " were") + " done already";
    if (failed > 0) text += ", " + grouped(failed) + " failed";
    return text + ", in " + duration_words(report.seconds) + "; " +
           counted(report.regions_read, "region was", "regions were") + " opened";
}

std::string sentence_of_check(const BatchReport& report) {
    return lines_words(report.lines.size()) + ": " + grouped(report.count(LineState::to_do)) + " to do, " +
           grouped(report.count(LineState::kept)) + " done already, " +
           grouped(report.count(LineState::failed)) + " that cannot be done";
}

}  // namespace

std::size_t BatchReport::count(LineState state) const {
    return static_cast<std::size_t>(std::ranges::count(lines, state, &LineReport::state));
}

std::string duration_words(double seconds) {
    const auto whole = static_cast<long long>(std::llround(std::max(0.0, seconds)));
    if (whole < 100) return std::to_string(whole) + " s";
    const long long minutes = (whole + 30) / 60;
    if (minutes < 100) return std::to_string(minutes) + " min";
    const long long rest = minutes % 60;
    return std::to_string(minutes / 60) + " h" + (rest > 0 ? " " + std::to_string(rest) + " min" : "");
}

void tell_batch(const BatchOptions& options, const BatchReport& report) {
    if (options.json) {
        std::printf("%s\n", json_text(report_json(options, report), true).c_str());
        return;
    }
    if (options.check)
        std::printf("%s\n", sentence_of_check(report).c_str());
    else
        say(options.quiet, sentence_of(report));
}

}  // namespace oro
