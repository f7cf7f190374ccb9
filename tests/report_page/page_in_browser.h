#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/scene/json.h"
#include "tests/temporary_folder.h"

namespace report_page {

// Takes steps, as inBrowser() has them, in a page; anything that the page complains about fails the
// test. Skips where there is no browser or no Plotly.
class PageInBrowser : public testing::Test {
protected:
    void SetUp() override;

    // In the page of A, knownReport(); or of A and B, which is half as slow again.
    benchmarks::scene::Json one(const std::string& steps, int width = 1280);
    benchmarks::scene::Json two(const std::string& steps);

    benchmarks::scene::Json open(
        const std::vector<std::filesystem::path>& files, const std::string& steps,
        int width = 1280);

    TemporaryFolder folder_;
};

}  // namespace report_page
