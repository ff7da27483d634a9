// The bundled region baked with clusters, and pictures of it.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/baked/baking.h"
#include "tests/apps/said_json.h"

namespace oro::test {

class ClustersDrawn : public Bake {
  protected:
    const fs::path out_ = folder / "tile.oro", picture_ = folder / "picture.png";

    void SetUp() override { baked_into(out_); }
    static void baked_into(const fs::path& file) {
        const Outcome outcome =
            run_orograph({"bake", bundled(), "--mesh", "clusters", "--out", file.string(), "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    static Words eye() {
        return {"--at", "36.53,-84.35", "--above", "900",    "--heading",
                "70",   "--pitch",      "-15",     "--size", "240x160"};
    }
    Words shot_words(const Words& more) const {
        return joined(joined({"shot", out_, "--out", picture_, "-q", "--overwrite"}, eye()), more);
    }
    nlohmann::json shot(const Words& more) const {
        return object_said_by(joined(shot_words(more), {"--json"}));
    }
    Outcome refused(const Words& more) const { return run_orograph(shot_words(more)); }
};

}  // namespace oro::test
