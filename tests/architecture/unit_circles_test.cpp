#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Tests for circles of units. A unit is a .cpp with the header of its name, or only one of them.
// Even without a cycle of headers, units can depend on each other: a.cpp includes b.h, and b.cpp
// a.h. Then neither unit can be understood, tested or reused without the other.
namespace {

using Includes = std::map<std::string, std::vector<std::string>>;  // file -> its includes

std::string unitOf(const std::string& file) { return file.substr(0, file.rfind('.')); }

// Edges between units, with the files that each comes from.
using Units = std::map<std::string, std::map<std::string, std::vector<std::string>>>;

Units unitsOf(const Includes& files) {
    Units units;
    for (const auto& [file, included] : files) units[unitOf(file)];
    for (const auto& [file, included] : files)
        for (const std::string& each : included)
            if (const std::string to = unitOf(each); files.contains(each) && to != unitOf(file))
                units[unitOf(file)][to].push_back(file);
    return units;
}

// Finds the strongly connected components with more than one unit. Tarjan 1972, Depth-first search
// and linear graph algorithms.
class CircleSearch {
public:
    explicit CircleSearch(const Units& units) : units_(units) {
        for (const auto& [unit, edges] : units_)
            if (!places_.contains(unit)) visit(unit);
    }

    // The units of each circle, sorted.
    const std::vector<std::vector<std::string>>& circles() const { return circles_; }

private:
    struct Place {
        std::size_t number = 0;  // in the order of the visits
        std::size_t lowest = 0;  // number reached from here
        bool open = true;
    };

    std::size_t visit(const std::string& unit) {
        const std::size_t number = places_.size();
        places_[unit] = {.number = number, .lowest = number};
        path_.push_back(unit);
        std::size_t lowest = number;
        for (const auto& [to, files] : units_.at(unit)) {
            if (!places_.contains(to))
                lowest = std::min(lowest, visit(to));
            else if (places_.at(to).open)
                lowest = std::min(lowest, places_.at(to).number);
        }
        if (lowest == number) close(unit);
        return lowest;
    }

    // Takes the units off the path that are in one component with `unit`.
    void close(const std::string& unit) {
        const auto first = std::ranges::find(path_, unit);
        std::vector<std::string> circle(first, path_.end());
        path_.erase(first, path_.end());
        for (const std::string& each : circle) places_.at(each).open = false;
        std::ranges::sort(circle);
        if (circle.size() > 1) circles_.push_back(std::move(circle));
    }

    const Units& units_;
    std::map<std::string, Place> places_;
    std::vector<std::string> path_;
    std::vector<std::vector<std::string>> circles_;
};

// Returns a line for each edge of each circle: "a -> b (a.cpp, a.h)".
std::vector<std::string> circularEdges(const Includes& files) {
    const Units units = unitsOf(files);
    const CircleSearch search(units);
    std::vector<std::string> lines;
    for (const std::vector<std::string>& circle : search.circles()) {
        for (const std::string& unit : circle) {
            for (const auto& [to, sources] : units.at(unit)) {
                if (!std::ranges::binary_search(circle, to)) continue;
                std::string line = unit + " -> " + to + " (";
                for (std::size_t i = 0; i < sources.size(); ++i)
                    line += (i == 0 ? "" : ", ") + sources[i];
                lines.push_back(line + ')');
            }
        }
    }
    return lines;
}

std::vector<std::string> ownIncludes(const std::filesystem::path& file) {
    static const std::regex pattern(R"-(^\s*#\s*include\s*"([^"]+)".*)-");
    std::vector<std::string> found;
    std::ifstream stream(file);
    std::smatch match;
    for (std::string line; std::getline(stream, line);)
        if (line.find("include") != std::string::npos && std::regex_match(line, match, pattern))
            found.push_back(match[1]);
    return found;
}

// The includes of all C++ files in these folders.
Includes sourcesIn(std::initializer_list<std::string_view> folders) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    Includes files;
    for (const std::string_view folder : folders) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const std::filesystem::path& path = entry.path();
            if (path.extension() != ".h" && path.extension() != ".cpp") continue;
            files[std::filesystem::relative(path, root).generic_string()] = ownIncludes(path);
        }
    }
    return files;
}

TEST(Units, AreInNoCircle) {
    const Includes files = sourcesIn({"engine", "hair", "benchmarks"});
    EXPECT_GT(files.size(), 100u);
    EXPECT_THAT(circularEdges(files), testing::IsEmpty());
}

// Returns the headers of `files` that at most one other unit includes. Each file of `tests` counts
// as a unit.
std::vector<std::string> headersForOneUnit(const Includes& files, const Includes& tests) {
    std::map<std::string, std::set<std::string>> users;  // header -> units
    for (const Includes* part : {&files, &tests})
        for (const auto& [file, included] : *part)
            for (const std::string& each : included)
                if (unitOf(file) != unitOf(each)) users[each].insert(unitOf(file));
    std::vector<std::string> found;
    for (const auto& [file, included] : files)
        if (file.ends_with(".h") && users[file].size() <= 1) found.push_back(file);
    return found;
}

std::size_t linesOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return static_cast<std::size_t>(
        std::count(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>(), '\n'));
}

// Counts of the product's source. If one rises, a new file may belong to an existing unit:
// docs/design.md, How to judge a unit. If one falls, lower its bound here. Lines have no bound.
TEST(Units, AreAsFewAsTheyWere) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    const Includes files = sourcesIn({"engine", "hair", "benchmarks"});
    std::size_t sources = 0, lines = 0;
    for (const auto& [file, included] : files) {
        sources += file.ends_with(".cpp") ? 1 : 0;
        lines += linesOf(root / file);
    }
    std::size_t shaders = 0, shader_lines = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "shaders")) {
        if (!entry.is_regular_file() || entry.path().filename() == "CMakeLists.txt") continue;
        ++shaders;
        shader_lines += linesOf(entry.path());
    }
    const std::vector<std::string> for_code = headersForOneUnit(files, {});
    const std::vector<std::string> for_all = headersForOneUnit(files, sourcesIn({"tests"}));

    struct Row {
        std::string_view counted;
        std::size_t count, most;  // 0: no bound
    };
    const Row rows[] = {
        {"C++ files", files.size(), 431},
        {"translation units", sources, 229},
        {"headers for at most one unit of the product", for_code.size(), 20},
        {"headers for at most one unit or test", for_all.size(), 2},
        {"files of shaders", shaders, 211},
        {"lines of C++", lines, 0},
        {"lines of shaders", shader_lines, 0}};
    for (const Row& row : rows) {
        std::cout << std::setw(8) << row.count << "  " << row.counted;
        if (row.most > 0) std::cout << ", at most " << row.most;
        std::cout << '\n';
        if (row.most > 0) {
            EXPECT_LE(row.count, row.most) << row.counted;
        }
    }
    if (HasFailure()) ADD_FAILURE() << "for one unit: " << testing::PrintToString(for_code);
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// A value is named, by one of these texts, in the files that make, convert or use it. Other files
// pass it on inside its struct.
struct Way {
    std::string_view value;
    std::vector<std::string_view> names;
    std::string_view without;  // a folder whose files set the value for experiments; may be empty
    std::size_t most;
};

bool isNamedIn(const std::string& text, const Way& way) {
    return std::ranges::any_of(
        way.names, [&](std::string_view name) { return text.find(name) != std::string::npos; });
}

// Fails if a value is named in more files than before. Code in such a file should get the value
// inside its struct, typed. If a count falls, lower its bound.
TEST(Ways, AreAsShortAsTheyWere) {
    const Way ways[] = {
        {"/strands/density", {"strands.density"}, "", 5},
        {"/simulation/time_step",
         {".time_step", "float time_step", "double time_step", "/time_step", "\"time_step\""},
         "benchmarks/physics/",
         10},
        {"a scene's JSON read as settings", {"readSettings("}, "", 4},
        {"settings written as JSON", {"writeSettings(", "writeFields("}, "", 13},
        {"a device's type by its name",
         {"type == \"cpu\"", "type != \"cpu\"", "type == \"discrete\"", "type == \"integrated\""},
         "",
         0},
        {"a finished case in the journal", {"eachCase(["}, "", 1}};
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    std::map<std::string_view, std::vector<std::string>> found;  // way -> files
    for (const auto& [file, included] : sourcesIn({"engine", "hair", "benchmarks"})) {
        const std::string text = textOf(root / file);
        for (const Way& way : ways)
            if ((way.without.empty() || !file.starts_with(way.without)) && isNamedIn(text, way))
                found[way.value].push_back(file);
    }
    for (const Way& way : ways) {
        const std::vector<std::string>& files = found[way.value];
        std::cout << std::setw(8) << files.size() << "  files name " << way.value << ", at most "
                  << way.most << '\n';
        EXPECT_LE(files.size(), way.most)
            << way.value << " is named in " << testing::PrintToString(files);
    }
}

TEST(Units, HeadersForOneUnitAreFound) {
    using testing::ElementsAre;
    const Includes files{
        {"a.cpp", {"a.h", "b.h", "c.h"}},
        {"a.h", {}},
        {"b.h", {"c.h"}},
        {"c.h", {"vector"}},
        {"d.h", {"a.h"}}};
    EXPECT_THAT(headersForOneUnit(files, {}), ElementsAre("a.h", "b.h", "d.h"));
    EXPECT_THAT(
        headersForOneUnit(files, {{"b_test.cpp", {"b.h"}}, {"d_test.cpp", {"d.h"}}}),
        ElementsAre("a.h", "d.h"));
}

TEST(Units, OfACircleAreNamedWithTheirEdges) {
    using testing::ElementsAre;
    using testing::IsEmpty;
    // A registry that is also its implementations' interface makes a circle of units, but no cycle
    // of headers.
    EXPECT_THAT(
        circularEdges(
            {{"x/list.h", {}},
             {"x/list.cpp", {"x/list.h", "x/one.h", "x/two.h"}},
             {"x/one.h", {"x/list.h"}},
             {"x/one.cpp", {"x/one.h", "x/list.h"}},
             {"x/two.h", {"x/part.h"}},
             {"x/two.cpp", {"x/two.h"}},
             {"x/part.h", {}},
             {"main.cpp", {"x/list.h"}}}),
        ElementsAre("x/list -> x/one (x/list.cpp)", "x/one -> x/list (x/one.cpp, x/one.h)"));
    // A longer circle. Two circles with a common unit are one circle.
    EXPECT_THAT(
        circularEdges(
            {{"a.cpp", {"b.h"}},
             {"a.h", {}},
             {"b.cpp", {"c.h", "d.h"}},
             {"b.h", {}},
             {"c.cpp", {"a.h"}},
             {"c.h", {}},
             {"d.cpp", {"b.h"}},
             {"d.h", {}}}),
        ElementsAre(
            "a -> b (a.cpp)", "b -> c (b.cpp)", "b -> d (b.cpp)", "c -> a (c.cpp)",
            "d -> b (d.cpp)"));
    // Two paths to a unit, a .cpp with its own header, and files of libraries are no circles.
    EXPECT_THAT(
        circularEdges(
            {{"a.cpp", {"a.h", "b.h", "c.h"}},
             {"a.h", {"vector"}},
             {"b.h", {"d.h"}},
             {"c.h", {"d.h"}},
             {"d.cpp", {"d.h", "other/a.h"}},
             {"d.h", {}}}),
        IsEmpty());
}

}  // namespace
