#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/scene/json.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {

// Runs steps in a page in headless Chromium without a network: the program in HAIRBENCH_BROWSER, or
// one of its usual names in PATH. Skips without a browser or Plotly.
//
// Steps are the body of an async JavaScript function, with
//   say(name, value)      adds a value to the result
//   settle()              waits until the page has reacted
//   choose(id, value)     chooses from a list
//   type(id, text)        types into a box
//   figure(id)            returns Plotly's traces of a figure
//   column(table, index)  returns the texts of a column
// Returns the values from say(). The test fails for complaints of the console, uncaught errors or
// the page's security policy, for network requests, and if the page does not reach the end of the
// steps.
class PageInBrowser : public testing::Test {
protected:
    void SetUp() override;

    // Opens the page of A, knownReport(), or of A and B, which takes 1.5 times as long.
    scene::Json one(const std::string& steps, int width = 1280);
    scene::Json two(const std::string& steps);

    // Opens the page that `hairbench report` makes of these reports.
    scene::Json open(
        const std::vector<std::filesystem::path>& reports, const std::string& steps,
        int width = 1280);

    TemporaryFolder folder_;
};

}  // namespace benchmarks::report
