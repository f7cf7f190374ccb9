#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "tests/fuzz/targets.h"
#include "tests/groom/formats/mutations.h"
#include "tests/temporary_folder.h"

// Tests the targets without a fuzzer, on seeds, findings and damaged seeds.
namespace fuzz {
namespace {

using hair::groom::Dice;

class FuzzTarget : public testing::TestWithParam<std::string> {
protected:
    // `what` describes the bytes.
    void expectRefusedOrRead(const std::string& bytes, const std::string& what) {
        try {
            target_.read(bytes);
        } catch (const engine::Error&) {
        } catch (const std::exception& error) {
            ADD_FAILURE() << what << ": " << error.what();
        }
    }

    const Target& target_ = targetNamed(GetParam());
};

// If a seed is refused, a fuzzer does not reach the code after the refusal.
TEST_P(FuzzTarget, ReadsItsSeeds) {
    const auto seeds = seedsOf(target_);
    EXPECT_FALSE(seeds.empty());
    for (const std::filesystem::path& file : seeds)
        EXPECT_NO_THROW(target_.read(textOf(file))) << file;
}

TEST_P(FuzzTarget, RefusesOrReadsWhatWasFound) {
    for (const std::filesystem::path& file : findingsOf(target_))
        expectRefusedOrRead(textOf(file), file.string());
}

using Json = nlohmann::ordered_json;

// Returns a random value of the document, or the document itself.
Json& anyValue(Json& document, Dice& dice) {
    Json* value = &document;
    while (value->is_structured() && !value->empty() && dice.below(8) != 0)
        value = &*std::next(value->begin(), static_cast<std::ptrdiff_t>(dice.below(value->size())));
    return *value;
}

// Takes texts of JSON in lines or between record separators. Chooses a text and replaces one of its
// values by another of its values, or by a value that is wrong almost everywhere. Returns "" if the
// chosen text is no JSON.
std::string misshapen(const std::string& texts, Dice& dice) {
    const std::vector<Json> wrong{
        nullptr,
        true,
        -1,
        0,
        18446744073709551615u,
        1e300,
        -0.0,
        "",
        "no number",
        "a\n",
        Json::array(),
        Json::object(),
        Json::array({1, "a"}),
        0.5,
        {{"a", {{"b", 1}}}}};
    const std::size_t place = dice.below(texts.size());
    const std::size_t before = texts.find_last_of("\x1e\n", place);
    const std::size_t begin = before == texts.npos ? 0 : before + 1;
    const std::size_t end = std::min(texts.find_first_of("\x1e\n", begin), texts.size());
    Json document = Json::parse(texts.substr(begin, end - begin), nullptr, false);
    if (document.is_discarded()) return {};
    Json other = dice.below(2) == 0 ? anyValue(document, dice) : wrong[dice.below(wrong.size())];
    anyValue(document, dice) = std::move(other);
    return texts.substr(0, begin) + document.dump() + texts.substr(end);
}

// Tries $HAIRBENCH_MUTATIONS mutations of each target, the same in every run.
TEST_P(FuzzTarget, RefusesOrReadsDamagedSeeds) {
    const char* const wanted = std::getenv("HAIRBENCH_MUTATIONS");
    const int count = wanted ? std::atoi(wanted) : 40;
    const auto seeds = seedsOf(target_);
    ASSERT_FALSE(seeds.empty());
    for (int i = 0; i < count; ++i) {
        Dice dice(static_cast<std::uint32_t>(i));
        const std::string seed = textOf(seeds[dice.below(seeds.size())]);
        std::string bytes = misshapen(seed, dice);
        if (bytes.empty())
            bytes = hair::groom::mutated(seed, textOf(seeds[dice.below(seeds.size())]), dice);
        expectRefusedOrRead(bytes, "mutation " + std::to_string(i));
    }
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Target& target : targets()) all.push_back(target.name);
    return all;
}

std::string nameOf(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Targets, FuzzTarget, testing::ValuesIn(names()), nameOf);

}  // namespace
}  // namespace fuzz
