#include <algorithm>

#include <gtest/gtest.h>

#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/mutations.h"
#include "tests/groom/formats/strand_files.h"

// A short, repeatable version of scripts/test --fuzz, which has coverage and more time. A damaged
// file of the corpus must give an engine::Error or a valid set.
namespace hair::groom {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMutations = 3000;  // for each importer

std::vector<std::string> seedsOf(const StrandImporter& importer) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::recursive_directory_iterator(corpus("")))
        for (const std::string_view extension : importer.extensions)
            if (entry.path().extension() == extension) paths.push_back(entry.path());
    std::ranges::sort(paths);
    std::vector<std::string> seeds;
    for (const fs::path& path : paths) seeds.push_back(textOf(path));
    return seeds;
}

// Empty if the reader refuses the file properly or reads it.
std::string whatHappensTo(const StrandImporter& importer, const std::string& bytes) {
    try {
        return brokenPromise(readText(importer.read, bytes));
    } catch (const engine::Error&) {
        return "";
    } catch (const std::exception& other) {
        return std::string("not an engine::Error: ") + other.what();
    }
}

TEST(Mutations, AreRefusedOrRead) {
    for (const StrandImporter& importer : strandImporters()) {
        if (importer.extensions.front() == ".usd") continue;  // another program reads it
        const std::vector<std::string> seeds = seedsOf(importer);
        ASSERT_FALSE(seeds.empty()) << importer.name;
        for (std::uint32_t i = 0; i < kMutations; ++i) {
            Dice dice(i);
            std::string bytes = seeds[dice.below(seeds.size())];
            const std::string& other = seeds[dice.below(seeds.size())];
            for (std::uint32_t k = 0; k <= dice.below(4); ++k) bytes = mutated(bytes, other, dice);
            ASSERT_EQ(whatHappensTo(importer, bytes), "") << importer.name << ", mutation " << i;
        }
    }
}

}  // namespace
}  // namespace hair::groom
