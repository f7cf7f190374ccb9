#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

#include "tests/exporters/exported.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace benchmarks::report {
namespace {

using testing::HasSubstr;

// Returns the path of compare.py: HAIRBENCH_GBENCH_COMPARE, or that of Debian's libbenchmark-tools.
std::string comparePy() {
    const char* wanted = std::getenv("HAIRBENCH_GBENCH_COMPARE");
    const std::string path = wanted && *wanted ? wanted : "/usr/share/benchmark/compare.py";
    return std::filesystem::exists(path) ? path : "";
}

// Returns a Python with numpy and scipy, which compare.py needs.
std::string interpreter() {
    for (const std::string& python :
         {std::string(HAIRBENCH_SOURCE_DIR "/.deps/reference/bin/python"), pythonInterpreter(),
          std::string("python3")})
        if (!python.empty() &&
            runInShell("'" + python + "' -c 'import numpy, scipy' 2>&1").status == 0)
            return python;
    return "";
}

TEST(Gbench, IsReadByGoogleBenchmarksComparePy) {
    const std::string script = comparePy();
    const std::string python = interpreter();
    if (script.empty())
        return skipWithout(Need::gbench, "no compare.py: install libbenchmark-tools");
    if (python.empty()) GTEST_SKIP() << "no Python with numpy and scipy";
    const TemporaryFolder folder;
    Report slower = sampleReport();
    for (double& sample : slower.cases[0].metrics[0].samples) sample *= 1.5;
    const auto a = folder.write("a.json", exported("gbench"));
    const auto b = folder.write("b.json", exportReport(reportJson(slower), "gbench"));
    const Outcome outcome = runInShell(
        "'" + python + "' -B '" + script + "' --no-color benchmarks '" + a.string() + "' '" +
        b.string() + "' 2>&1");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    // Name, change of time, change of CPU time, and times in us without decimals.
    EXPECT_THAT(
        outcome.output, testing::ContainsRegex("backend:tessellation/frame.time +\\+0.5000 +"
                                               "\\+0.5000 +3000 +4500 +3000 +4500"));
    EXPECT_THAT(
        outcome.output, testing::ContainsRegex("pass.strands.time +\\+0.0000 +\\+0.0000 +2500"));
    EXPECT_THAT(outcome.output, testing::Not(HasSubstr("memory.device")));
}

}  // namespace
}  // namespace benchmarks::report
