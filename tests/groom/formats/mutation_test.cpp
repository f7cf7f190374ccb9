#include <algorithm>

#include <gtest/gtest.h>

#include "hair/random.h"
#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/bytes.h"
#include "tests/groom/formats/strand_files.h"

// What scripts/test --fuzz does with coverage and time, in a second and always the same: damaged
// files of the corpus make an engine::Error or a set as it ought to be, nothing else.
namespace hair::groom {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMutations = 3000;  // of each importer

// A stream of hashes: its n-th is the same on every machine.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : seed_(seed) {}
    std::uint32_t below(std::size_t count) {
        return hash(seed_, thrown_++, 0) %
               static_cast<std::uint32_t>(std::max<std::size_t>(count, 1));
    }

private:
    std::uint32_t seed_;
    std::uint32_t thrown_ = 0;
};

std::string mutated(std::string bytes, const std::string& other, Dice& dice) {
    const std::size_t at = dice.below(bytes.size());
    switch (bytes.empty() ? 4 : dice.below(6)) {
    case 0:
        bytes[at] ^= static_cast<char>(1u << dice.below(8));
        break;
    case 1:
        bytes[at] = static_cast<char>(dice.below(256));
        break;
    case 2:
        bytes.resize(at);
        break;
    case 3:
        bytes.erase(at, dice.below(16));
        break;
    case 4:
        bytes.insert(at, other, dice.below(other.size()), dice.below(64));
        break;
    case 5:
        if (const std::size_t aligned = at / 4 * 4; aligned + 4 <= bytes.size())
            bytes = patched(bytes, aligned, kWrongCounts[dice.below(std::size(kWrongCounts))]);
        break;
    }
    return bytes;
}

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

// Empty where it is refused as it should be or read.
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
