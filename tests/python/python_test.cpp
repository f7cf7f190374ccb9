// Tests the Python module in benchmarks/python, its documents, and the CI steps for other
// repositories, by the scripts beside this file.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/python.h"
#include "tests/required.h"

namespace {

class PythonModule : public testing::TestWithParam<std::string> {};

TEST_P(PythonModule, PassesItsTests) {
    const std::string interpreter = interpreterOf("module");
    if (interpreter.empty())
        return skipWithout(
            Need::module, "no environment of the module: run scripts/setup --module");
    // USD is among the formats.
    if (GetParam() == "groom" && pythonInterpreter().empty())
        return skipWithout(Need::python, kNoPython);
    setenv("HAIRBENCH_PROGRAM", HAIRBENCH_PROGRAM, 1);
    const Outcome outcome = runPython("tests/python/" + GetParam() + "_test.py", "", interpreter);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    Tests, PythonModule,
    testing::Values("ci", "documents", "groom", "program", "report", "thesis", "typing"),
    [](const auto& test) { return test.param; });

}  // namespace
