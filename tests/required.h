#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

// Capabilities that some tests need and a machine may lack.
enum class Need {
    device,
    validation,
    gbench,
    python,
    module,  // hairbench's Python module
    report,
    browser,
    display,
    swiftshader,
    mesh,  // task and mesh stages
    rays,  // ray queries
    null_gpus,  // scripts/null-gpu
};

inline constexpr std::array<std::string_view, 12> kNeedNames{
    "device",  "validation", "gbench",      "python", "module", "report",
    "browser", "display",    "swiftshader", "mesh",   "rays",   "null_gpus"};
static_assert(kNeedNames.size() == static_cast<std::size_t>(Need::null_gpus) + 1);

// Whether HAIRBENCH_REQUIRE, a list with commas, names this need. scripts/test lists there what it
// has set up. Throws for unknown names.
inline bool isRequired(Need need) {
    const char* const variable = std::getenv("HAIRBENCH_REQUIRE");
    bool found = false;
    for (std::string_view left = variable ? variable : ""; !left.empty();) {
        const std::string_view name = left.substr(0, left.find(','));
        left.remove_prefix(std::min(left.size(), name.size() + 1));
        std::size_t index = 0;
        while (index < kNeedNames.size() && kNeedNames[index] != name) ++index;
        if (index == kNeedNames.size())
            throw std::invalid_argument("HAIRBENCH_REQUIRE: there is no " + std::string(name));
        found = found || index == static_cast<std::size_t>(need);
    }
    return found;
}

// Ends a test that lacks a need: fails it if the need is required, otherwise skips it. In a test or
// a SetUp(): if (...) return skipWithout(Need::display, "there is no display");
inline void skipWithout(Need need, const std::string& reason) {
    if (isRequired(need))
        GTEST_FAIL() << reason << "; HAIRBENCH_REQUIRE asks for "
                     << kNeedNames[static_cast<std::size_t>(need)];
    GTEST_SKIP() << reason;
}

// Whether SetUp() has ended a test.
inline bool isOver() { return testing::Test::IsSkipped() || testing::Test::HasFatalFailure(); }
