// How accurate a picture shall be: bundles, single options over them, and a tolerance that chooses one.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;

class Accuracy : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path picture = folder / "p.png";

    Outcome run(const std::string& command, const Words& more) const {
        Words words{command,     bundled(), "--at",    "36.6,-84.2", "--above", "300",
                    "--heading", "200.5",   "--pitch", "-5",         "--size",  "96x54"};
        if (command == "shot")
            words.insert(words.end(), {"--out", picture.string(), "--overwrite", "--json"});
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
    json said(const Outcome& outcome) const {
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json reported = json::parse(outcome.out, nullptr, false);
        EXPECT_TRUE(reported.is_object()) << outcome.out;
        return reported.is_object() ? reported : json::object();
    }
    json view_of_picture() const { return json::parse(oro::test::view_in(picture), nullptr, false); }
    // What `plan` says a view would be: the same resolution of options, and nothing drawn.
    json planned_view(const Words& more) const {
        Words words{"--json", "-q"};
        words.insert(words.end(), more.begin(), more.end());
        return said(run("plan", words)).at("view");
    }
};

void expect_models(const json& view, const char* bundle, double tau_px, const char* heights,
                   double refraction_k, const char* air = "constant") {
    EXPECT_EQ(view.at("accuracy"), bundle);
    EXPECT_EQ(view.at("tau_px"), tau_px);
    EXPECT_EQ(view.at("heights"), heights);
    EXPECT_EQ(view.at("refraction"), refraction_k);
    EXPECT_EQ(view.at("air"), air);
}

TEST_F(Accuracy, BundlesSetWhatTheySay) {
    expect_models(planned_view({"--accuracy", "draft"}), "draft", 4.0, "i16", 0.0);
    expect_models(planned_view({"--accuracy", "balanced"}), "balanced", 0.5, "f32", 0.13, "standard");
    expect_models(planned_view({"--accuracy", "survey"}), "survey", 0.0, "f32", 0.13, "standard");
    const json shot = said(run("shot", {"-q", "--accuracy", "draft"}));
    EXPECT_EQ(shot.at("accuracy"), json({{"bundle", "draft"}}));
    EXPECT_EQ(shot.at("tau_px"), 4.0);
    EXPECT_EQ(shot.at("models").at("heights"), "i16");
    expect_models(view_of_picture(), "draft", 4.0, "i16", 0.0);
}

// Found: such a view was said to be "draft" all the same.
TEST_F(Accuracy, SingleOptionsWinAndTheNameGoes) {
    expect_models(planned_view({"--accuracy", "draft", "--tau", "2"}), "", 2.0, "i16", 0.0);
    expect_models(planned_view({"--refraction", "0.2", "--accuracy", "balanced"}), "", 0.5, "f32", 0.2);
    expect_models(planned_view({"--accuracy", "survey", "--heights", "i16"}), "", 0.0, "i16", 0.13,
                  "standard");
    expect_models(planned_view({"--accuracy", "survey", "--tau", "0"}), "survey", 0.0, "f32", 0.13,
                  "standard");
    EXPECT_TRUE(said(run("shot", {"-q", "--accuracy", "draft", "--tau", "2"})).at("accuracy").is_null());
}

TEST_F(Accuracy, AToleranceChoosesAndTheChoiceIsRecorded) {
    const Outcome outcome = run("shot", {"--tolerance", "1px"});
    const json accuracy = said(outcome).at("accuracy");
    EXPECT_EQ(accuracy.at("bundle"), "balanced");
    EXPECT_EQ(accuracy.at("options"), "--tau 0.5 --heights f32 --air standard");
    EXPECT_EQ(accuracy.at("tolerance_px"), 1.0);
    EXPECT_EQ(accuracy.at("holds"), true);
    EXPECT_GE(accuracy.at("predicted_px").get<double>(), 0.5);
    EXPECT_LE(accuracy.at("predicted_px").get<double>(), 1.0);
    EXPECT_NE(outcome.err.find("accuracy: balanced, predicted error 0.5"), std::string::npos) << outcome.err;
    expect_models(view_of_picture(), "balanced", 0.5, "f32", 0.13, "standard");
    const Outcome plan = run("plan", {"--tolerance", "1px", "--json", "-q"});
    EXPECT_EQ(said(plan).at("cheapest").at("accuracy"), accuracy.at("bundle"));
    EXPECT_EQ(said(plan).at("cheapest").at("predicted_px"), accuracy.at("predicted_px"));
    // The view holds what was chosen: it chooses nothing any more.
    const fs::path again = folder / "again.png";
    const Outcome drawn = run_orograph({"shot", "--view", picture, "--out", again, "-q", "--json"});
    EXPECT_EQ(said(drawn).at("accuracy"), json({{"bundle", "balanced"}}));
    EXPECT_TRUE(bytes_of(again) == bytes_of(picture));
}

TEST_F(Accuracy, ToleranceFromLooseToTight) {
    EXPECT_EQ(said(run("shot", {"-q", "--tolerance", "100"})).at("accuracy").at("bundle"), "draft");
    const json tight = said(run("shot", {"-q", "--tolerance", "0.001px"})).at("accuracy");
    EXPECT_EQ(tight.at("bundle"), "survey");
    EXPECT_EQ(tight.at("holds"), tight.at("predicted_px").get<double>() <= 0.001);
}

// Found: 0.5 px were promised to hold 1 px, and tau was 50.
TEST_F(Accuracy, WhatSingleOptionsFixIsInThePrediction) {
    const Outcome outcome = run("shot", {"--tolerance", "1px", "--tau", "50"});
    const json accuracy = said(outcome).at("accuracy");
    EXPECT_TRUE(accuracy.at("bundle").is_null());
    EXPECT_EQ(accuracy.at("options"), "--tau 50 --heights f32 --air standard");
    EXPECT_EQ(accuracy.at("holds"), false);
    EXPECT_GT(accuracy.at("predicted_px").get<double>(), 1.0);
    EXPECT_NE(outcome.err.find("accuracy: --tau 50 "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("more than the tolerance"), std::string::npos) << outcome.err;
    expect_models(view_of_picture(), "", 50.0, "f32", 0.13, "standard");
    const json held = said(run("shot", {"-q", "--tolerance", "1px", "--tau", "0.1"})).at("accuracy");
    EXPECT_EQ(held.at("options"), "--tau 0.1 --heights i16 --refraction 0") << "draft but for tau";
    EXPECT_EQ(held.at("holds"), true);
}

TEST_F(Accuracy, BadValuesLeaveNothingBehind) {
    const auto refused = [&](const Words& more, const Words& says) {
        expect_refusal(run("shot", more), usage, says);
    };
    for (const char* tolerance : {"0", "-1", "1 px px", "1e-9", "nan", "1e999", ""})
        refused({"--tolerance", tolerance}, {"--tolerance"});
    refused({"--tolerance", "1px", "--accuracy", "draft"}, {"--tolerance", "--accuracy"});
    refused({"--accuracy", "best"}, {"--accuracy", "best"});
    expect_refusal(run_orograph({"view", bundled(), "--tolerance", "1px"}), usage, {"--tolerance"});
    EXPECT_EQ(names_in(folder), Words{});
}

// Found: any text was taken for a bundle's name, and the name of one for what it stands for.
TEST_F(Accuracy, AViewIsWhatItsFieldsAre) {
    const json view = planned_view({"--accuracy", "draft"});
    const fs::path file = folder / "v.json";
    const auto plan_with = [&](const char* field, const json& value) {
        json changed = view;
        changed[field] = value;
        oro::test::write_bytes(file, changed.dump());
        return run_orograph({"plan", "--view", file, "--json", "-q"});
    };
    expect_models(said(plan_with("tau_px", 3.0)).at("view"), "", 3.0, "i16", 0.0);
    expect_models(said(plan_with("accuracy", "survey")).at("view"), "", 4.0, "i16", 0.0);
    const std::vector<std::pair<const char*, json>> broken{{"accuracy", "nonsense"},
                                                           {"accuracy", 5},
                                                           {"accuracy", nullptr},
                                                           {"refraction", "0.13"},
                                                           {"refraction", -1.1},
                                                           {"refraction", 1e300},
                                                           {"refraction", nullptr},
                                                           {"earth", "disc"},
                                                           {"earth", 1},
                                                           {"heights", "i8"},
                                                           {"heights", nullptr},
                                                           {"geoid", true},
                                                           {"precision", ""},
                                                           {"tau_px", "1"},
                                                           {"tau_px", -1},
                                                           {"air", "thick"},
                                                           {"air", 1}};
    for (const auto& [field, value] : broken) {
        SCOPED_TRACE(field + (" " + value.dump()));
        expect_refusal(plan_with(field, value), failed, {"v.json", "'" + std::string(field) + "'"});
    }
    for (const char* text : {"", "[]", R"({"orograph_view":1)", R"({"orograph_view":1,"tau_px":NaN})",
                             R"({"orograph_view":1,"refraction":1e999})"}) {
        oro::test::write_bytes(file, text);
        expect_refusal(run_orograph({"plan", "--view", file}), failed, {"v.json"});
    }
}

}  // namespace
