#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/scene/json.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {

// Takes steps in a page in headless Chromium, without a network: what HAIRBENCH_BROWSER names, or
// one of its usual names in PATH. Skips where there is no browser or no Plotly.
//
// Steps are the body of an async JavaScript function, which has
//   say(name, value)      into the result
//   settle()              waits until the page has answered to what was done
//   choose(id, value)     from a list
//   type(id, text)        into a box
//   figure(id)            Plotly's traces in it
//   column(table, index)  the texts of a column
// What was said is returned. The test fails where the console, uncaught errors or the page's
// security policy complain, where the page asks for something of the network, and where it never
// comes to the end of the steps.
class PageInBrowser : public testing::Test {
protected:
    void SetUp() override;

    // In the page of A, knownReport(); or of A and B, which is half as slow again.
    scene::Json one(const std::string& steps, int width = 1280);
    scene::Json two(const std::string& steps);

    // In the page of these reports, as `hairbench report` makes it.
    scene::Json open(
        const std::vector<std::filesystem::path>& reports, const std::string& steps,
        int width = 1280);

    TemporaryFolder folder_;
};

}  // namespace benchmarks::report
