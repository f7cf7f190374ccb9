#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_hairbench.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"
#include "tests/viewer/virtual_display.h"

// The viewer as a user starts it, in the test's own folder and driven by a script.
class ViewTest : public testing::Test {
protected:
    void SetUp() override {
        if (!display_.variables())
            return skipWithout(Need::display, "there is neither Xvfb nor a display");
        // Few strands and pixels, because lavapipe draws them on the processor.
        folder_.write("small.json", R"({
            "base": ")" HAIRBENCH_SCENES_DIR R"(/thesis.json",
            "simulation": {"settle_steps": 30},
            "strands": {"density": 4, "tessellation": 2},
            "render": {"width": 160, "height": 90},
            "run": {"warmup": 2, "frames": 1, "max_time": 0},
            "sweep": {"/groom/guides": null, "/strands/density": null,
                      "/strands/tessellation": null, "/render/msaa": null, "/lod/level": null}})");
    }

    // Returns the stderr and exit status of `hairbench view small.json`.
    Outcome view(const std::string& script, const std::string& arguments = "") {
        const std::filesystem::path file = folder_.write("script.json", script);
        Outcome outcome = hairbenchErrors(
            "view small.json --script script.json --validate " + arguments,
            "cd '" + folder_.path().string() + "' && " + *display_.variables());
        outcome.output = folder_.relative(outcome.output);
        return outcome;
    }

    void expectGood(const std::string& script, const std::string& arguments = "") {
        const Outcome outcome = view(script, arguments);
        EXPECT_EQ(outcome.status, 0) << arguments;
        EXPECT_EQ(outcome.output, "") << arguments;
    }

    // Runs another command of the program in the same folder.
    Outcome run(const std::string& arguments) const {
        return hairbench(arguments, "cd '" + folder_.path().string() + "' && ");
    }

    // Reads a file from the step "state".
    nlohmann::json state(const std::string& name) const {
        return nlohmann::json::parse(textOf(folder_.file(name)));
    }

    TemporaryFolder folder_;

private:
    VirtualDisplay display_;
};
