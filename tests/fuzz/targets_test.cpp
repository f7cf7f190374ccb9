#include <exception>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/fuzz/targets.h"
#include "tests/temporary_folder.h"

// What fuzzers start from and what they have found, without a fuzzer.
namespace fuzz {
namespace {

class FuzzTarget : public testing::TestWithParam<Target> {};

// A seed that is refused teaches a fuzzer nothing of what is behind the refusal.
TEST_P(FuzzTarget, ReadsItsSeeds) {
    const auto seeds = seedsOf(GetParam());
    EXPECT_FALSE(seeds.empty());
    for (const std::filesystem::path& file : seeds)
        EXPECT_NO_THROW(GetParam().read(textOf(file))) << file;
}

TEST_P(FuzzTarget, RefusesOrReadsWhatWasFound) {
    for (const std::filesystem::path& file : findingsOf(GetParam())) {
        try {
            GetParam().read(textOf(file));
        } catch (const engine::Error&) {
        } catch (const std::exception& error) {
            ADD_FAILURE() << file << ": " << error.what();
        }
    }
}

std::string nameOf(const testing::TestParamInfo<Target>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Targets, FuzzTarget, testing::ValuesIn(targets().begin(), targets().end()), nameOf);

}  // namespace
}  // namespace fuzz
