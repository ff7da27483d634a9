// Who may know whom: the include lines of every source file and the link lists of every CMakeLists.txt,
// checked against one table. What is not allowed there is forbidden.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;
using oro::test::is_source;
using oro::test::text_of;

// What a folder may include and link, as regular expressions for whole names. Includes in <> and "" are one
// kind here.
struct Layer {
    std::vector<std::string> includes;
    std::vector<std::string> links;
};

const std::string standard_library = "[a-z_]+";  // <vector>, <cstdint>: no dot, no slash

const std::map<std::string, Layer>& layers() {
    static const std::map<std::string, Layer> table = {
        {"shaders", {{standard_library, "glm/.*", "shaders/.*\\.(glsl|h)"}, {}}},
        {"core",
         {{standard_library, "(fcntl|unistd|sys/[a-z]+|zstd|zstd_errors|xxhash|erfa|immintrin)\\.h", "glm/.*",
           "meshoptimizer\\.h", "core/.*", "shaders/.*\\.(glsl|h)"},
          {"orograph_options", "glm::glm", "meshoptimizer(::meshoptimizer)?", "(zstd|erfa)::static"}}},
        {"geo",
         {{standard_library, "(fcntl|unistd|sys/[a-z]+|zlib|libdeflate)\\.h", "glm/.*", "core/.*", "geo/.*",
           "(cpl|gdal|ogr|vrt)[a-z_]*\\.h", "proj\\.h", "GeographicLib/.*", "libexif/.*",
           "(png|jpeglib|tiffio|tiff|utf8|sqlite3|geos_c|meshoptimizer)\\.h", "pugixml\\.hpp", "nlohmann/.*",
           "curl/curl\\.h"},
          {"orograph_core", "GDAL::GDAL", "PROJ::proj", "PkgConfig::(GEOGRAPHICLIB|EXIF)", "PNG::PNG",
           "meshoptimizer::meshoptimizer", "JPEG::JPEG", "TIFF::TIFF", "ZLIB::ZLIB", "CURL::libcurl",
           "pugixml::pugixml", "utf8::cpp", "SQLite::SQLite3", "PkgConfig::(GEOS|DEFLATE)",
           "nlohmann_json::nlohmann_json"}}},
        {"render",
         {{standard_library, "glm/.*", "core/.*", "render/.*", "shaders/.*\\.(glsl|h)", "spirv/.*\\.h",
           "vulkan/.*", "GLFW/.*", "(backends/)?imgui.*\\.h"},
          {"orograph_core", "orograph_render", "orograph_shaders", "Vulkan::Vulkan", "glfw",
           "(PkgConfig::IMGUI|imgui::imgui)", "Freetype::Freetype"}}},
        {"apps", {{"(?!tests/).*"}, {"(?!orograph_test|GTest).*"}}},
    };
    return table;
}

bool allowed(const std::vector<std::string>& patterns, const std::string& name) {
    for (const std::string& pattern : patterns) {
        if (std::regex_match(name, std::regex(pattern))) return true;
    }
    return false;
}

// The include lines of a source text that its layer forbids, each as it is written.
std::vector<std::string> forbidden_includes(const Layer& layer, const std::string& text) {
    static const std::regex directive("^[ \t]*#[ \t]*include[ \t]*(.*)$");
    static const std::regex named("[<\"]([^<>\"]+)[>\"].*");
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::smatch include, name;
        if (!std::regex_match(line, include, directive)) continue;
        const std::string what = include[1];
        // An include by macro names nothing that could be checked.
        if (!std::regex_match(what, name, named) || name[1].str().find("..") != std::string::npos ||
            !allowed(layer.includes, name[1]))
            found.push_back(line);
    }
    return found;
}

// The names in a CMake text's link lists that its layer forbids.
std::vector<std::string> forbidden_links(const Layer& layer, const std::string& text) {
    const std::string code = std::regex_replace(text, std::regex("#[^\n]*"), "");
    static const std::regex list("(target_)?link_libraries[ \t\n]*\\(([^)]*)\\)", std::regex::icase);
    std::vector<std::string> found;
    for (std::sregex_iterator at(code.begin(), code.end(), list), end; at != end; ++at) {
        std::istringstream words((*at)[2].str());
        std::string word;
        if ((*at)[1].matched) words >> word;  // the target itself
        while (words >> word) {
            if (word == "PUBLIC" || word == "PRIVATE" || word == "INTERFACE") continue;
            if (!allowed(layer.links, word)) found.push_back(word);
        }
    }
    return found;
}

const Layer& layer(const std::string& name) {
    return layers().at(name);
}

class LayersTest : public testing::TestWithParam<std::string> {};

TEST_P(LayersTest, FolderKeepsToItsLayer) {
    const fs::path folder = oro::test::project_folder() / GetParam();
    int sources = 0, lists = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (is_source(entry.path())) {
            ++sources;
            for (const std::string& line : forbidden_includes(layer(GetParam()), text_of(entry.path())))
                ADD_FAILURE() << entry.path() << " may not say: " << line;
        } else if (entry.path().filename() == "CMakeLists.txt") {
            ++lists;
            for (const std::string& name : forbidden_links(layer(GetParam()), text_of(entry.path())))
                ADD_FAILURE() << entry.path() << " may not link " << name;
        }
    }
    EXPECT_GE(sources, 5) << "of " << folder;
    EXPECT_EQ(lists, 1) << "of " << folder;
}
INSTANTIATE_TEST_SUITE_P(Folders, LayersTest, testing::Values("shaders", "core", "geo", "render", "apps"),
                         [](const auto& folder) { return folder.param; });

// The checker itself, on what it must and must not find.
using Strings = std::vector<std::string>;

TEST(LayersChecker, FindsForbiddenIncludes) {
    EXPECT_EQ(forbidden_includes(layer("core"), "#include <gdal_priv.h>\n"),
              Strings{"#include <gdal_priv.h>"});
    EXPECT_EQ(
        forbidden_includes(layer("core"), "#include <vector>\n  #  include \"geo/region/region.h\"\n").size(),
        1U);
    EXPECT_EQ(forbidden_includes(layer("core"), "#include <vulkan/vulkan.h>").size(), 1U);
    EXPECT_EQ(forbidden_includes(layer("core"), "#include <GeographicLib/Geocentric.hpp>").size(), 1U);
    EXPECT_EQ(forbidden_includes(layer("core"), "#include \"core/../geo/region.h\"").size(), 1U);
    EXPECT_EQ(forbidden_includes(layer("core"), "#include SOME_HEADER").size(), 1U);
    EXPECT_EQ(
        forbidden_includes(layer("geo"), "#include \"render/device/gpu.h\"\n#include <vulkan/vulkan.hpp>")
            .size(),
        2U);
    EXPECT_EQ(forbidden_includes(layer("render"),
                                 "#include \"geo/region/region.h\"\n#include <proj.h>\n#include <gdal.h>")
                  .size(),
              3U);
    EXPECT_EQ(forbidden_includes(layer("render"), "#include <GeographicLib/Geodesic.hpp>").size(), 1U);
    EXPECT_EQ(forbidden_includes(layer("shaders"), "#include \"core/terrain/page.h\"").size(), 1U);
    EXPECT_EQ(forbidden_includes(layer("apps"), "#include \"tests/support/test_data.h\"").size(), 1U);
}

TEST(LayersChecker, LetsAllowedIncludesPass) {
    const std::string fine =
        "#pragma once\n#include <vector>\n#include <glm/vec3.hpp>\n#include \"core/terrain/page.h\"\n";
    EXPECT_EQ(forbidden_includes(layer("core"), fine), Strings{});
    EXPECT_EQ(forbidden_includes(layer("core"), "#include \"shaders/shared.h\"  // layout\n"), Strings{});
    EXPECT_EQ(forbidden_includes(layer("geo"), fine + "#include <gdal_priv.h>\n#include <proj.h>\n"),
              Strings{});
    EXPECT_EQ(forbidden_includes(layer("render"), fine + "#include <vulkan/vulkan.h>\n"), Strings{});
}

TEST(LayersChecker, FindsForbiddenLinks) {
    EXPECT_EQ(forbidden_links(layer("core"),
                              "target_link_libraries(orograph_core PUBLIC glm::glm\n  PRIVATE GDAL::GDAL)"),
              Strings{"GDAL::GDAL"});
    EXPECT_EQ(forbidden_links(layer("render"), "target_link_libraries(orograph_render PUBLIC orograph_geo)"),
              Strings{"orograph_geo"});
    EXPECT_EQ(forbidden_links(layer("geo"), "TARGET_LINK_LIBRARIES(orograph_geo Vulkan::Vulkan)"),
              Strings{"Vulkan::Vulkan"});
    EXPECT_EQ(forbidden_links(layer("core"), "link_libraries(proj)"), Strings{"proj"});
    EXPECT_EQ(forbidden_links(layer("core"),
                              "# target_link_libraries(orograph_core gdal)\n"
                              "target_link_libraries(orograph_core PUBLIC orograph_options glm::glm)"),
              Strings{});
}

}  // namespace
