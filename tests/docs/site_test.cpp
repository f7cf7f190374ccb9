// Tests the documentation's site by the script beside this file.
#include <string>

#include <gtest/gtest.h>

#include "tests/python.h"
#include "tests/required.h"

namespace {

// scripts/test sets up the browser and the environment together.
TEST(DocumentationSite, PassesItsTests) {
    const std::string interpreter = interpreterOf("docs");
    if (interpreter.empty())
        return skipWithout(
            Need::browser, "no environment of the documentation: run scripts/setup --docs");
    const Outcome outcome = runPython("tests/docs/site_test.py", "", interpreter);
    if (outcome.status == 77) return skipWithout(Need::browser, "there is no Chromium");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

}  // namespace
