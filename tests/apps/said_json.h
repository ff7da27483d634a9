// What the program says as JSON.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"

namespace oro::test {

// One valid JSON object and nothing else.
inline nlohmann::json one_object(const std::string& text) {
    const nlohmann::json object = nlohmann::json::parse(text, nullptr, false);
    EXPECT_TRUE(object.is_object()) << text;
    return object.is_object() ? object : nlohmann::json::object();
}
// Of a run that must end well.
inline nlohmann::json object_said_by(const std::vector<std::string>& words) {
    const Outcome outcome = run_orograph(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return one_object(outcome.out);
}

}  // namespace oro::test
