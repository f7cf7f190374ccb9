// The Python module in benchmarks/python, by the tests beside this file.
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/python.h"
#include "tests/required.h"

namespace {

class PythonModule : public testing::TestWithParam<const char*> {};

TEST_P(PythonModule, PassesItsTests) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    setenv("HAIRBENCH_PROGRAM", HAIRBENCH_PROGRAM, 1);
    const Outcome outcome = runPython("tests/python/" + std::string(GetParam()) + "_test.py", "");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

INSTANTIATE_TEST_SUITE_P(
    Tests, PythonModule, testing::Values("ci", "documents", "groom", "program", "report"),
    [](const auto& info) { return std::string(info.param); });

}  // namespace
