// Tables of sources as strangers may write them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "apps/fetch/public_sources.h"

namespace oro {
namespace {

nlohmann::json good_source() {
    return {{"title", "A"},         {"url", "http://127.0.0.1:1/{latitude}{longitude}.hgt.gz"},
            {"side_deg", 1},        {"file", "{latitude}{longitude}.hgt.gz"},
            {"format", "hgt.gz"},   {"holds", "heights"},
            {"missing", "sea"},     {"most_bytes", 1000000},
            {"licence", "for all"}, {"attribution", "Nobody"}};
}

std::string table_with(const char* field, const nlohmann::json& value) {
    nlohmann::json source = good_source();
    source[field] = value;
    return nlohmann::json{{"sources", {{"test", source}}}}.dump();
}

std::string fault_of_table(const std::string& text) {
    const auto sources = public_sources_from(text, "table.json");
    return sources.ok() ? "" : sources.error().line();
}

TEST(PublicSources, TakesAGoodTable) {
    const std::string text = nlohmann::json{{"sources", {{"test", good_source()}}}}.dump();
    EXPECT_EQ(fault_of_table(text), "");
    EXPECT_EQ(fault_of_table("\xEF\xBB\xBF" + text), "");
}

TEST(PublicSources, WhatIsWrongIsSaidInOneLine) {
    const std::string source = good_source().dump();
    std::string deep(100000, '[');
    const std::vector<std::pair<std::string, std::string>> tables{
        {"", "is no JSON"},
        {"[]", "an object with 'sources' was expected"},
        {"\"x\"", "an object with 'sources' was expected"},
        {"{}", "'sources' is missing"},
        {R"({"sources": []})",
         "'sources' must be an object"},
        {R"({"sources": {"test": 5}})", "source 'test' must be an object"},
        {R"({"sources": {"../x": )" + source + "}}", "'../x' is no name of a source"},
        {R"({"sources": {"test": )" + source + R"(, "test": )" + source + "}}", "'test' is there twice"},
        {R"({"sources": {}, "sources": {"test": )" + source + "}}", "'sources' is there twice"},
        {R"({"sources": {"test": )" + source.substr(0, source.size() - 1) + R"(, "url": "http://other/x"}}})",
         "'url' is there twice"},
        {R"({"sources": )" + deep, "nested deeper than 16"},
        {table_with("title", "A") + std::string(1, '\0'), "it is no text"},
        {table_with("title", std::string("a\0b", 3)), "'title' holds a zero byte"},
        {table_with("most_bytes", -1), "'most_bytes' is -1"},
        {table_with("most_bytes", 1e30), "'most_bytes' must be a whole number"},
        {table_with("side_deg", 0), "'side_deg' is 0"},
        {table_with("side_deg", 7), "'side_deg' must divide 180"},
        {table_with("side_deg", 1e308), "'side_deg' must be a whole number"},
        {table_with("format", "exe"), "'format' must be one of"},
        {table_with("file", "../{latitude}{longitude}"), "without folders"},
        {table_with("file", "/etc/{latitude}{longitude}"), "without folders"},
        {table_with("file", "x.hgt.gz"), "'file' must have {latitude} and {longitude}"},
        {table_with("url", "file:///etc/{latitude}{longitude}"), "'url' must begin with https:// or http://"},
        {table_with("url", "http://a:b@127.0.0.1/{latitude}{longitude}"), "no user or password"},
        {table_with("url", "http://127.0.0.1/\r\nHost: x{latitude}{longitude}"),
         "'url' holds a space or a control character"},
        {table_with("url", "http://127.0.0.1/{latitude"), "'url' must have {latitude} and {longitude}"},
        {table_with("nonsense", 1), "has no field 'nonsense'"},
        {R"({"cache_limit_gb": 1e999, "sources": {}})", "number overflow"},
        {R"({"cache_limit_gb": -1, "sources": {}})", "'cache_limit_gb' is -1"}};
    for (const auto& [text, says] : tables) {
        const std::string fault = fault_of_table(text);
        EXPECT_TRUE(fault.starts_with("table.json: is no table of sources: "))
            << fault << text.substr(0, 200);
        EXPECT_NE(fault.find(says), std::string::npos) << fault << "\n" << text.substr(0, 200);
        EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
        EXPECT_LT(fault.size(), 400U) << fault;
    }
}

}  // namespace
}  // namespace oro
