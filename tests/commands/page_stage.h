// The script of a trade's page, run without a browser: Duktape runs it, page_stage.js stands in for the
// document.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "apps/trade/trade_page.h"
#include "tests/support/test_data.h"

namespace oro::test {

// The repository's own folder.
inline std::filesystem::path repository() {
    return bundled_data().parent_path();
}

// What a script prints. It must end well.
inline std::string printed_by(const std::string& script) {
    const std::filesystem::path file = scratch_folder() / "script.js";
    std::ofstream(file, std::ios::binary) << script;
    std::FILE* const pipe = popen(("timeout 60 duk '" + file.string() + "' 2>&1").c_str(), "r");
    std::string said;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) said += static_cast<char>(c);
    const int status = pclose(pipe);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
        << "duk (Debian package duktape) says: " << said.substr(0, 2000);
    return said;
}

// The page's script with a document before it, and its data; `more` comes after it.
inline std::string staged(const TradeReport& report, const std::string& more) {
    std::ostringstream stage;
    stage << std::ifstream(repository() / "tests" / "commands" / "page_stage.js").rdbuf();
    return stage.str() + "var stagedReport = " + nlohmann::json(trade_page_json(report).dump()).dump() +
           ";\n" + trade_page_script + more;
}

// The page's places as its script fills them.
inline std::string drawn_page(const TradeReport& report) {
    return printed_by(staged(report, "print(stagedHtml());\n"));
}

// What an expression of the page's own functions is, as JSON.
inline nlohmann::json evaluated(const std::string& expression) {
    const std::string said = printed_by(staged({}, "print(JSON.stringify(" + expression + "));\n"));
    nlohmann::json value = nlohmann::json::parse(said, nullptr, false);
    EXPECT_FALSE(value.is_discarded()) << expression << ": " << said;
    return value;
}

}  // namespace oro::test
