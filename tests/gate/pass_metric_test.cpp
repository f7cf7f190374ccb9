#include "benchmarks/doctor/pass_metric.h"

#include <regex>

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

bool matches(const std::string& name, const std::string& regex) {
    return std::regex_search(name, std::regex(regex));
}

TEST(PassMetric, NamesItsPass) {
    EXPECT_EQ(passOf("pass.strands.time"), "strands");
    EXPECT_EQ(passOf("pass.strands.cpu.time"), "strands");
    EXPECT_EQ(passOf("pass.mesh_shadow.instructions"), "mesh_shadow");
    EXPECT_EQ(passOf("frame.cpu.time"), "");
    EXPECT_EQ(passOf("pass.strands.bytes"), "");
}

TEST(PassMetric, FindsTheSameOfAllPasses) {
    const std::string cpu = sameOfAllPasses("pass.strands.cpu.time");
    EXPECT_TRUE(matches("pass.wind.cpu.time", cpu));
    EXPECT_TRUE(matches("frame.cpu.time", cpu));
    EXPECT_FALSE(matches("pass.wind.time", cpu));
    const std::string wall = sameOfAllPasses("pass.strands.time");
    EXPECT_TRUE(matches("pass.wind.time", wall));
    EXPECT_TRUE(matches("frame.time", wall));
    EXPECT_FALSE(matches("pass.wind.cpu.time", wall));
    EXPECT_FALSE(matches("frame.first.time", wall));
}

TEST(PassMetric, KnowsEveryTime) {
    for (const char* const name :
         {"frame.time", "frame.cpu.time", "frame.instructions", "pass.wind.time",
          "pass.wind.cpu.time", "pass.wind.instructions"})
        EXPECT_TRUE(matches(name, kEveryTime)) << name;
    for (const char* const name :
         {"frame.first.time", "frame.overlap", "cpu.record.time", "fps", "memory.device"})
        EXPECT_FALSE(matches(name, kEveryTime)) << name;
}

}  // namespace
}  // namespace benchmarks
