// Tests the project's promises about its set-up.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kSourceTree = HAIRBENCH_SOURCE_DIR;

std::string wholeText(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// apt, pip and git know their hosts. A script that names a host bypasses them.
TEST(Setup, NamesNoHost) {
    // The name of SVG's namespace is no address: nothing is fetched.
    static const std::regex address(
        R"(\b(?!http://www\.w3\.org/2000/svg\")(https?|ftp|git|ssh)://[A-Za-z0-9])");
    std::size_t read = 0;
    for (const char* const folder : {"scripts", ".ci", "tests/container"})
        for (const auto& entry : fs::recursive_directory_iterator(kSourceTree / folder)) {
            if (!entry.is_regular_file()) continue;
            const std::string text = wholeText(entry.path());
            std::smatch match;
            EXPECT_FALSE(std::regex_search(text, match, address))
                << entry.path() << ": " << match.str();
            ++read;
        }
    EXPECT_GT(read, 10u);
    EXPECT_TRUE(std::regex_search(std::string("'https://host/file'"), address));
    EXPECT_TRUE(std::regex_search(std::string("'http://www.w3.org/2000/svg/file'"), address));
}

// scripts/test --fresh writes the rows: release, day, commit, Mesa and times.
TEST(Setup, ClaimsOnlyReleasesOnWhichBothCommandsRan) {
    static const std::regex claim(R"([Tt]ested(\]\([^)]*\))? on fresh [^.;]*)");
    static const std::regex release(R"((Debian|Ubuntu) [0-9.]*[0-9])");
    const std::string readme = wholeText(kSourceTree / "README.md");
    const std::string install = wholeText(kSourceTree / "docs/install.md");
    std::smatch sentence;
    if (!std::regex_search(readme, sentence, claim)) return;  // nothing is claimed
    const std::string claimed = sentence.str();
    std::size_t count = 0;
    for (std::sregex_iterator each(claimed.begin(), claimed.end(), release), end; each != end;
         ++each, ++count) {
        const std::regex row(
            R"(\| )" + each->str() +
            R"( \| \d{4}-\d\d-\d\d \| [0-9a-f]{12} \| [^|]+ \| \d+ CPU s, \d+ s \| \d+ passed, 0 failed; )" +
            R"(\d+ CPU s, \d+ s \|)");
        EXPECT_TRUE(std::regex_search(install, row))
            << "docs/install.md has no run on " << each->str();
    }
    EXPECT_GT(count, 0u);
}

std::string firstGroup(const fs::path& file, const std::string& pattern) {
    const std::string text = wholeText(kSourceTree / file);
    std::smatch match;
    return std::regex_search(text, match, std::regex(pattern)) ? match.str(1) : "none";
}

// scripts/release refuses other versions, too.
TEST(Setup, HasOneVersion) {
    const std::string version = firstGroup("CMakeLists.txt", R"(project\(hairbench VERSION (\S+))");
    EXPECT_THAT(version, testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_EQ(firstGroup("docs/CHANGELOG.md", R"(\n## ([^\s,]+))"), version);
    EXPECT_EQ(firstGroup("docs/CITATION.cff", R"(\nversion: (\S+)\n)"), version);
}

}  // namespace
