// Tests that the patches of docs/extending/ apply to the present source. scripts/test --extending
// builds and runs them.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <istream>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;
using ReadLines = std::function<std::optional<Lines>(const std::string& file)>;

Lines linesOf(std::istream& text) {
    Lines lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

std::optional<Lines> sourceLines(const std::string& file) {
    std::ifstream source(fs::path(HAIRBENCH_SOURCE_DIR) / file);
    if (!source) return std::nullopt;
    return linesOf(source);
}

// Returns "file: hunk: reason" for each hunk that does not apply. As for `git apply`, a hunk's old
// lines must follow each other in the file, after those of the hunk before.
Lines misfits(std::istream& patch, const ReadLines& read) {
    static const std::regex heading(R"(@@ -\d+(,(\d+))? \+\d+(,(\d+))? @@.*)");
    Lines found;
    std::string file;
    std::optional<Lines> source;
    std::size_t after = 0;  // end of the hunk before
    const Lines lines = linesOf(patch);
    for (std::size_t i = 0; i < lines.size();) {
        const std::string line = lines[i++];
        if (line.starts_with("--- ") && i < lines.size()) {
            const bool is_new = line == "--- /dev/null";
            file = lines[i++].substr(6);  // after "+++ b/"
            source = read(file);
            after = 0;
            if (is_new && source) found.push_back(file + ": it is there already");
            if (!is_new && !source) found.push_back(file + ": there is no such file");
            if (is_new && !source) source.emplace();
        }
        std::smatch counts;
        if (!std::regex_match(line, counts, heading) || !source) continue;
        const auto countOf = [&](std::size_t group) {
            return counts[group].matched ? std::stoul(counts[group]) : 1ul;
        };
        Lines old_lines;
        std::size_t new_lines = 0;
        for (; i < lines.size() &&
               (lines[i].empty() || std::string(" +-\\").find(lines[i][0]) != std::string::npos);
             ++i) {
            if (lines[i].starts_with("--- ")) break;
            const char kind = lines[i].empty() ? ' ' : lines[i][0];
            if (kind == ' ' || kind == '-')
                old_lines.push_back(lines[i].empty() ? "" : lines[i].substr(1));
            if (kind == ' ' || kind == '+') ++new_lines;
        }
        if (old_lines.size() != countOf(2) || new_lines != countOf(4))
            found.push_back(file + ": " + line + ": its lines are not as many as it says");
        const auto place = std::search(
            source->begin() + static_cast<std::ptrdiff_t>(after), source->end(), old_lines.begin(),
            old_lines.end());
        if (place == source->end() && !old_lines.empty())
            found.push_back(file + ": " + line + ": the file has not these lines");
        else
            after = static_cast<std::size_t>(place - source->begin()) + old_lines.size();
    }
    if (file.empty()) found.emplace_back("it changes no file");
    return found;
}

TEST(Patches, FitTheSource) {
    std::size_t count = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(HAIRBENCH_SOURCE_DIR) / "docs/extending")) {
        if (entry.path().extension() != ".patch") continue;
        ++count;
        std::ifstream patch(entry.path());
        EXPECT_THAT(misfits(patch, sourceLines), testing::IsEmpty())
            << entry.path().filename() << ": make it anew (docs/extending.md)";
    }
    EXPECT_EQ(count, 5u);
}

TEST(Patches, AreMissedWhereTheSourceHasChanged) {
    const std::string change = "--- a/a.cpp\n+++ b/a.cpp\n@@ -1,2 +1,3 @@ in\n one\n+new\n two\n@@ "
                               "-5 +6 @@\n-five\n+six\n";
    const std::string addition = "--- /dev/null\n+++ b/b.cpp\n@@ -0,0 +1 @@\n+one\n";
    const auto with = [](const std::string& patch, const std::optional<Lines>& source) {
        std::istringstream text(patch);
        return misfits(text, [&](const std::string&) { return source; });
    };
    EXPECT_THAT(with(change, Lines{"zero", "one", "two", "five"}), testing::IsEmpty());
    EXPECT_THAT(with(addition, std::nullopt), testing::IsEmpty());
    EXPECT_THAT(
        with(change, Lines{"one", "and", "two", "five"}),
        testing::ElementsAre("a.cpp: @@ -1,2 +1,3 @@ in: the file has not these lines"));
    EXPECT_THAT(
        with(change, Lines{"five", "one", "two"}),
        testing::ElementsAre("a.cpp: @@ -5 +6 @@: the file has not these lines"));
    EXPECT_THAT(with(change, std::nullopt), testing::ElementsAre("a.cpp: there is no such file"));
    EXPECT_THAT(with(addition, Lines{"one"}), testing::ElementsAre("b.cpp: it is there already"));
    EXPECT_THAT(with("nothing\n", std::nullopt), testing::ElementsAre("it changes no file"));
}

}  // namespace
