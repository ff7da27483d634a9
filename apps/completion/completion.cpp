#include "apps/completion/completion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <string_view>

namespace oro {
namespace {

const std::vector<std::string> elevation_endings = {"hgt", "tif", "tiff", "oro", "zip", "gz",
                                                    "tgz", "vrt", "jp2",  "dt0", "dt1", "dt2",
                                                    "dem", "img", "asc",  "bt",  "grd", "ter"};
const std::vector<std::string> view_endings = {"png", "jpg", "jpeg", "tif", "tiff", "svg", "json"};
const std::vector<std::string> vector_endings = {"gpx", "kml", "geojson", "json", "gpkg"};

// The files of an option. The first row that fits counts; "" fits every command.
struct FileRow {
    std::string_view command;
    std::string_view option;
    std::vector<std::string> endings;
};
const std::vector<FileRow>& file_rows() {
    static const std::vector<FileRow> rows = {
        {"", "PATH", elevation_endings},
        {"", "PICTURE", view_endings},
        {"", "--view", view_endings},
        {"", "--style", {"json", "txt"}},
        {"", "--names", vector_endings},
        {"", "--overlay", vector_endings},
        {"profile", "--along", vector_endings},
        {"shot", "--out", {"png", "jpg", "jpeg", "tif", "tiff"}},
        {"panorama", "--out", {"png", "jpg", "jpeg", "tif", "tiff", "svg"}},
        {"compare", "--out", {"png"}},
        {"profile", "--out", {"csv", "svg", "geojson"}},
        {"viewshed", "--out", {"tif", "tiff"}},
        {"horizon", "--out", {"tif", "tiff"}},
        {"bake", "--out", {"oro"}},
        {"export", "--out", {"tif", "tiff", "glb"}},
    };
    return rows;
}

std::vector<DescribedOption> options_where(const DescribedCommand& command, bool is_positional) {
    std::vector<DescribedOption> found;
    for (const DescribedOption& option : command.options)
        if (option.is_positional == is_positional) found.push_back(option);
    return found;
}

}  // namespace

CompletedValue completed_value(const DescribedCommand& command, const DescribedOption& option,
                               const std::vector<std::string>& styles) {
    CompletedValue value;
    value.words = option.choices;
    const std::string& name = option.names.back();
    if (name == "--style") value.words = styles;
    value.has_folders = option.value_word == "FOLDER";
    const auto row = std::ranges::find_if(file_rows(), [&](const FileRow& files) {
        return files.option == name && (files.command.empty() || files.command == command.name);
    });
    value.has_files = row != file_rows().end() || option.value_word == "FILE";
    if (row != file_rows().end()) value.endings = row->endings;
    return value;
}

const std::vector<std::string>& completion_shells() {
    static const std::vector<std::string> shells = {"bash", "zsh", "fish"};
    return shells;
}

std::string completion_script(const std::string& shell, const CompletionTexts& texts) {
    assert(std::ranges::find(completion_shells(), shell) != completion_shells().end());
    CompletionTexts listed = texts;
    std::erase_if(listed.commands, [](const DescribedCommand& command) { return !command.is_listed; });
    if (shell == "bash") return bash_completion(listed);
    return shell == "zsh" ? zsh_completion(listed) : fish_completion(listed);
}

std::vector<DescribedOption> named_options(const DescribedCommand& command) {
    return options_where(command, false);
}

std::vector<DescribedOption> positional_arguments(const DescribedCommand& command) {
    return options_where(command, true);
}

std::string spaced(const std::vector<std::string>& words, const std::string& between) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
    return all;
}

std::string first_sentence(const std::string& sentences) {
    for (std::size_t at = 0; (at = sentences.find(". ", at)) != std::string::npos; ++at) {
        const bool begins =
            at + 2 < sentences.size() && (std::isupper(static_cast<unsigned char>(sentences[at + 2])) != 0);
        if (begins) return sentences.substr(0, at);
    }
    return sentences.ends_with('.') ? sentences.substr(0, sentences.size() - 1) : sentences;
}

}  // namespace oro
