#include "benchmarks/measure/metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace benchmarks::measure {
namespace {

using report::Measured;
using testing::HasSubstr;
using testing::Not;

engine::ShaderProgram
program(std::vector<std::string> shaders, std::vector<engine::ShaderProgram::Figure> figures) {
    return {
        .name = "Compute",
        .shaders = std::move(shaders),
        .subgroup_size = 64,
        .figures = std::move(figures)};
}

double only(const report::CaseResult& result, const report::MetricId& id) {
    const report::Metric* const metric = report::findMetric(result.metrics, id);
    return metric ? metric->samples.at(0) : -1.0;
}

// Each driver has its own names.
TEST(ShaderCosts, HaveOneNameForWhatDriversShare) {
    const std::vector programs{
        program({"a.comp"}, {{"VGPRs", 24}, {"Spilled VGPRs", 3}, {"Instructions", 100}}),
        program({"b.comp"}, {{"Number of GPRs", 40}, {"SLM Size", 8}}),
        program({"c.comp"}, {{"Max live registers", 90}, {"Spill Count", 2}, {"Else", 7}})};
    report::CaseResult result;
    addShaderCosts(programs, result);
    EXPECT_EQ(only(result, report::ofShader("a:comp", Measured::registers)), 24);
    EXPECT_EQ(only(result, report::ofShader("a:comp", Measured::spills)), 3);
    EXPECT_EQ(only(result, report::ofShader("a:comp", Measured::instructions)), 100);
    EXPECT_EQ(only(result, report::ofShader("b:comp", Measured::registers)), 40);
    EXPECT_EQ(only(result, report::ofShader("b:comp", Measured::scratch)), 8);
    EXPECT_EQ(only(result, report::ofShader("c:comp", Measured::registers)), 90);
    EXPECT_EQ(result.metrics.size(), 7u);
    ASSERT_EQ(result.shaders.size(), 3u);  // with every figure, under the driver's name
    EXPECT_EQ(result.shaders[2].figures.back().first, "Else");
    EXPECT_EQ(result.shaders[2].subgroup_size, 64u);
}

// Pipelines with other constants have equal stages. Fewer waves are worse, and more of everything
// else.
TEST(ShaderCosts, AreTheWorstOfEqualStages) {
    const std::vector<std::string> stages{"strands/a.vert", "strands/a.tesc+packed"};
    const std::vector programs{
        program(stages, {{"VGPRs", 24}, {"Subgroups per SIMD", 8}}),
        program(stages, {{"VGPRs", 64}, {"Subgroups per SIMD", 4}}),
        program(stages, {{"VGPRs", 32}, {"Subgroups per SIMD", 16}})};
    report::CaseResult result;
    addShaderCosts(programs, result);
    const std::string part = "strands/a:vert&strands/a:tesc+packed";
    EXPECT_EQ(only(result, report::ofShader(part, Measured::registers)), 64);
    EXPECT_EQ(only(result, report::ofShader(part, Measured::waves)), 4);
    EXPECT_EQ(result.metrics.size(), 2u);
    for (const report::Metric& metric : result.metrics)
        EXPECT_EQ(report::metricNamed(metric.name()), metric.id) << metric.name();
}

TEST(ShaderCosts, AreARowPerProgramAndTheWorstOfCases) {
    std::vector<report::CaseResult> cases(2);
    addShaderCosts(std::vector{program({"a.comp"}, {{"VGPRs", 24}})}, cases[0]);
    addShaderCosts(std::vector{program({"a.comp"}, {{"VGPRs", 61}})}, cases[1]);
    const std::string table = shaderTable(cases);
    EXPECT_THAT(table, HasSubstr("registers"));
    EXPECT_THAT(table, HasSubstr("61"));
    EXPECT_THAT(table, Not(HasSubstr("24")));
    EXPECT_THAT(table, Not(HasSubstr("spills")));  // no program tells them
    EXPECT_EQ(shaderTable({}), "");
}

}  // namespace
}  // namespace benchmarks::measure
