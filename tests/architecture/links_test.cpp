// Tests that the links of the project's pages are not broken.
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = HAIRBENCH_SOURCE_DIR;

std::vector<fs::path> pages() {
    std::vector<fs::path> found{kRoot / "README.md"};
    for (const char* const folder : {"docs", "results", "scenes", "tests", ".github"}) {
        if (!fs::is_directory(kRoot / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
            if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
    return found;
}

// Returns a page without code in fences and between backticks, which has no links.
std::string prose(std::istream& page) {
    static const std::regex code("`[^`]*`");
    std::string all;
    std::string line;
    bool fenced = false;
    while (std::getline(page, line)) {
        if (line.starts_with("```"))
            fenced = !fenced;
        else if (!fenced)
            all += std::regex_replace(line, code, "") + '\n';
    }
    return all;
}

// Returns GitHub's anchor of a heading: in lower case, with hyphens for blanks, without other
// signs.
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) || byte >= 0x80 || c == '_' || c == '-')
            anchor += static_cast<char>(std::tolower(byte));
        else if (c == ' ')
            anchor += '-';
    }
    return anchor;
}

std::set<std::string> anchorsIn(std::istream& page) {
    std::set<std::string> anchors;
    std::map<std::string, int> seen;
    std::string line;
    bool fenced = false;
    while (std::getline(page, line)) {
        if (line.starts_with("```")) fenced = !fenced;
        const std::size_t hashes = line.find_first_not_of('#');
        if (fenced || hashes == 0 || hashes == std::string::npos || line[hashes] != ' ') continue;
        const std::string anchor = anchorOf(line.substr(hashes + 1));
        const int times = seen[anchor]++;
        anchors.insert(times == 0 ? anchor : anchor + '-' + std::to_string(times));
    }
    return anchors;
}

// Returns "file: link: reason" for each broken link.
std::vector<std::string> brokenLinks(const fs::path& path) {
    static const std::regex link(R"(\]\(([^)\s]+)\))");
    std::ifstream page(path);
    const std::string text = prose(page);
    std::vector<std::string> broken;
    for (std::sregex_iterator each(text.begin(), text.end(), link), end; each != end; ++each) {
        const std::string target = (*each)[1];
        if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
        const std::size_t hash = target.find('#');
        const std::string file = target.substr(0, hash);
        const fs::path wanted =
            file.empty() ? path : (path.parent_path() / file).lexically_normal();
        const std::string name = path.lexically_relative(kRoot).string() + ": " + target;
        if (!fs::exists(wanted)) {
            broken.push_back(name + ": no such file");
            continue;
        }
        if (hash == std::string::npos || wanted.extension() != ".md") continue;
        std::ifstream other(wanted);
        if (!anchorsIn(other).contains(target.substr(hash + 1)))
            broken.push_back(name + ": no such heading");
    }
    return broken;
}

TEST(Links, LeadToWhatIsThere) {
    std::size_t count = 0;
    for (const fs::path& page : pages()) {
        ++count;
        EXPECT_THAT(brokenLinks(page), testing::IsEmpty());
    }
    EXPECT_GT(count, 15u);
}

// Returns texts between backticks that look like a file in a folder. Shaders may be relative to
// shaders/ and tests to tests/. A part "x" stands for any name.
std::set<std::string> filesNamedIn(std::istream& page) {
    static const std::regex file(
        R"(`([A-Za-z0-9_.-]+(?:/[A-Za-z0-9_.-]+)*/[A-Za-z0-9_.-]+\.)"
        R"((?:cpp|h|glsl|comp|vert|frag|geom|tesc|tese|task|mesh|py|md|js|sh|json))`)");
    static const std::regex placeholder(R"((^|[/_])x[_.])");
    std::set<std::string> files;
    std::string line;
    bool fenced = false;
    while (std::getline(page, line)) {
        if (line.starts_with("```")) fenced = !fenced;
        if (fenced) continue;
        for (std::sregex_iterator each(line.begin(), line.end(), file), end; each != end; ++each)
            if (const std::string name = (*each)[1]; !std::regex_search(name, placeholder))
                files.insert(name);
    }
    return files;
}

bool isFile(const fs::path& page, const std::string& name) {
    for (const fs::path& folder : {kRoot, kRoot / "shaders", kRoot / "tests", page.parent_path()})
        if (fs::is_regular_file(folder / name)) return true;
    return false;
}

TEST(Links, FilesThatPagesNameAreThere) {
    // A library's header, and a file that a patch adds.
    const std::set<std::string> others{"re2/re2.h", "hair/groom/formats/csv.cpp"};
    std::size_t count = 0;
    for (const fs::path& path : pages()) {
        std::ifstream page(path);
        for (const std::string& name : filesNamedIn(page)) {
            if (others.contains(name) || name.starts_with("results/local/")) continue;
            ++count;
            EXPECT_TRUE(isFile(path, name)) << path.lexically_relative(kRoot) << ": " << name;
        }
    }
    EXPECT_GT(count, 200u);
}

// Adds the names of the passes that a folder's files record.
void addPassNames(const fs::path& folder, std::set<std::string>& names) {
    static const std::regex recorded(R"re(passes\.pass\(\s*"([a-z_]+)")re");
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".cpp") continue;
        std::stringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        const std::string all = text.str();
        for (std::sregex_iterator each(all.begin(), all.end(), recorded), end; each != end; ++each)
            names.insert((*each)[1]);
    }
}

TEST(Pages, TheFramesHasEveryPass) {
    std::set<std::string> names;
    addPassNames(kRoot / "hair", names);
    addPassNames(kRoot / "benchmarks", names);
    for (const char* own : {"limit", "work"})  // measure the device outside frames
        names.erase(own);
    EXPECT_GE(names.size(), 15u);
    std::stringstream page;
    page << std::ifstream(kRoot / "docs/design.md").rdbuf();
    for (const std::string& name : names)
        EXPECT_THAT(page.str(), testing::HasSubstr('`' + name + '`'));
}

// Headings of this project, with the anchors that GitHub made, copied by hand.
TEST(Links, AnchorsAreThoseOfGitHub) {
    EXPECT_EQ(anchorOf("8,704 strands, not 5,568"), "8704-strands-not-5568");
    EXPECT_EQ(anchorOf("What tests/architecture holds"), "what-testsarchitecture-holds");
    std::istringstream page("# Twice\n\n```\n# no heading\n```\n## Twice\n#none\n");
    EXPECT_EQ(anchorsIn(page), (std::set<std::string>{"twice", "twice-1"}));
}

}  // namespace
