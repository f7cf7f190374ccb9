#include "tests/required.h"

#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

namespace {

// Changes the variable until the end of a test.
class RequiredTest : public testing::Test {
protected:
    ~RequiredTest() override {
        if (before_)
            setenv("HAIRBENCH_REQUIRE", before_->c_str(), 1);
        else
            unsetenv("HAIRBENCH_REQUIRE");
    }

    static void require(const char* names) { setenv("HAIRBENCH_REQUIRE", names, 1); }

private:
    static std::optional<std::string> value() {
        const char* const set = std::getenv("HAIRBENCH_REQUIRE");
        return set ? std::optional<std::string>(set) : std::nullopt;
    }

    std::optional<std::string> before_ = value();
};

TEST_F(RequiredTest, IsWhatTheVariableNames) {
    unsetenv("HAIRBENCH_REQUIRE");
    EXPECT_FALSE(isRequired(Need::python));
    require("");
    EXPECT_FALSE(isRequired(Need::python));
    require("python");
    EXPECT_TRUE(isRequired(Need::python));
    EXPECT_FALSE(isRequired(Need::display));
    require("device,validation,report,display");
    EXPECT_FALSE(isRequired(Need::python));
    EXPECT_FALSE(isRequired(Need::browser));
    for (const Need need : {Need::device, Need::validation, Need::report, Need::display})
        EXPECT_TRUE(isRequired(need));
}

TEST_F(RequiredTest, HasToBeKnown) {
    require("python,pyhton");
    EXPECT_THAT(
        [] { isRequired(Need::python); },
        testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("pyhton")));
}

TEST_F(RequiredTest, FailsATestThatLacksIt) {
    require("python");
    EXPECT_FATAL_FAILURE(skipWithout(Need::python, "no Python here"), "no Python here");
}

TEST_F(RequiredTest, SkipsATestThatLacksAnythingElse) {
    require("display");
    testing::TestPartResultArray results;
    {
        const testing::ScopedFakeTestPartResultReporter reporter(
            testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &results);
        skipWithout(Need::python, "no Python here");
    }
    ASSERT_EQ(results.size(), 1);
    EXPECT_TRUE(results.GetTestPartResult(0).skipped());
    EXPECT_THAT(results.GetTestPartResult(0).message(), testing::StartsWith("no Python here"));
}

}  // namespace
