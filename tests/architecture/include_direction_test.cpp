#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

// Tests which folder may include which. CMake orders the libraries, but it can't see an include
// that links by chance.
namespace {

struct Rule {
    std::string_view folder;     // "" is every folder
    std::string_view forbidden;  // beginning of forbidden includes
    std::string_view except = "none";  // files with this beginning may include it
    std::string_view also = "none";    // files with this beginning, too
};

constexpr Rule kRules[] = {
    // Includes go only downward: tests -> benchmarks -> hair -> engine.
    {"engine/", "hair/"},
    {"engine/", "benchmarks/"},
    {"engine/", "shaders/"},
    {"hair/", "benchmarks/"},
    {"", "tests/", "tests/"},
    {"shaders/", "engine/"},
    {"shaders/", "hair/"},
    {"shaders/", "benchmarks/"},
    // The program does not contain the references for the device's results.
    {"", "hair/reference/", "tests/", "hair/reference/"},

    // Rendering knows nothing of the simulation except the strand view that it gets.
    {"hair/rendering/", "hair/simulation/"},
    {"hair/simulation/", "hair/rendering/"},
    {"hair/groom/", "hair/rendering/"},
    {"hair/groom/", "hair/simulation/"},
    // The viewer plays cases. No measurement knows of it.
    {"benchmarks/", "benchmarks/viewer/", "benchmarks/viewer/", "benchmarks/commands/"},
    // C++ includes structures that it shares with GLSL in one place for hair, one for measurement
    // and one for the viewer.
    {"hair/", "shaders/", "hair/gpu_structs.h"},
    {"benchmarks/", "shaders/", "benchmarks/measure/gpu_structs.h",
     "benchmarks/viewer/picture_area.cpp"},
    {"tests/", "shaders/"},

    // Only one place includes each dependency.
    {"engine/", "nlohmann/"},
    {"hair/", "nlohmann/", "hair/groom/mesh/gltf_model.cpp"},
    {"", "CLI/", "benchmarks/commands/command_line_options.h"},
    {"engine/", "assimp/"},
    {"benchmarks/", "assimp/"},
    {"hair/", "assimp/", "hair/groom/mesh/mesh_reader.cpp"},
    {"", "draco/", "hair/groom/mesh/gltf_compression.cpp", "tests/"},
    {"", "meshoptimizer", "hair/groom/mesh/gltf_compression.cpp", "tests/"},
    {"", "tiny_gltf", "hair/groom/mesh/gltf_model.h"},
    {"", "stb", "engine/"},
    {"", "OpenEXR/", "engine/float_pictures.cpp"},
    {"", "volk", "engine/instance.h"},
    {"", "vulkan/", "engine/instance."},
    {"", "vk_mem_alloc", "engine/memory.h"},
    {"", "GLFW/", "engine/window.cpp"},
    {"", "backends/imgui", "engine/ui.cpp"},
    {"engine/", "imgui", "engine/ui"},
    {"hair/", "imgui"},
    {"benchmarks/", "imgui", "benchmarks/viewer/"},
    {"", "glslang/", "engine/"},
    {"", "re2/", "benchmarks/scene/pattern."},
    {"", "valijson/", "benchmarks/doctor/reports.cpp"},
    {"", "gtest/", "tests/"},
    {"", "gmock/", "tests/"},
};

// The only folder that knows which system the program runs on.
constexpr std::string_view kSystemFolder = "engine/system/";

// Beginnings of headers that POSIX, Linux or Windows have and other systems lack. Error numbers
// (<cerrno>) and signals (<csignal>) have headers of C, but other values on each system.
constexpr std::string_view kSystemHeaders[] = {
    "sys/",     "linux/",    "asm/",    "arpa/",     "net/",        "netinet/",  "unistd.h",
    "fcntl.h",  "signal.h",  "csignal", "errno.h",   "cerrno",      "dlfcn.h",   "link.h",
    "dirent.h", "poll.h",    "sched.h", "spawn.h",   "semaphore.h", "termios.h", "pthread.h",
    "pwd.h",    "grp.h",     "glob.h",  "fnmatch.h", "execinfo.h",  "mach/",     "seccomp.h",
    "ext/",     "win",       "Win",     "psapi.h",   "io.h",        "process.h", "direct.h",
    "shlobj",   "tlhelp32.h"};

// Beginnings of paths that only Linux has. Texts that a program prints begin otherwise.
constexpr std::string_view kSystemPaths[] = {"/proc", "/sys/", "/dev/fd", "/etc/", "/bin/sh"};

// Returns the system headers and paths in a file's text.
std::vector<std::string> systemThingsIn(const std::string& text) {
    static const std::regex include(R"(^\s*#\s*include\s*<([^>]+)>.*)");
    std::vector<std::string> found;
    std::istringstream stream(text);
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
        if (std::regex_match(line, match, include) &&
            std::ranges::any_of(kSystemHeaders, [&](std::string_view each) {
                return match[1].str().starts_with(each);
            }))
            found.push_back(match[1]);
        for (const std::string_view each : kSystemPaths)
            if (line.find('"' + std::string(each)) != std::string::npos) found.emplace_back(each);
    }
    return found;
}

constexpr std::string_view kFolders[] = {"engine", "hair", "benchmarks", "tests", "shaders"};

// The folders of benchmarks/. Each includes only itself and folders before it.
constexpr std::string_view kLayers[] = {"scene",  "report",    "measure", "groom", "physics",
                                        "ablate", "reference", "lod",     "run",   "gate",
                                        "doctor", "viewer",    "commands"};

// Returns the index in kLayers of the folder of a file in benchmarks/; absent for any other file.
std::optional<std::ptrdiff_t> layerOf(std::string_view file) {
    constexpr std::string_view kRoot = "benchmarks/";
    if (!file.starts_with(kRoot)) return std::nullopt;
    const std::string_view folder =
        file.substr(kRoot.size(), file.find('/', kRoot.size()) - kRoot.size());
    const auto layer = std::ranges::find(kLayers, folder);
    if (layer == std::end(kLayers)) return std::nullopt;
    return layer - std::begin(kLayers);
}

bool breaks(const Rule& rule, std::string_view file, std::string_view include) {
    return file.starts_with(rule.folder) && include.starts_with(rule.forbidden) &&
           !file.starts_with(rule.except) && !file.starts_with(rule.also);
}

bool isSource(const std::filesystem::path& path) {
    return path.extension() == ".h" || path.extension() == ".cpp";
}

// Returns paths relative to the repository, with '/' on every system.
std::vector<std::string> sources(const std::filesystem::path& root, std::string_view folder) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
        if (entry.is_regular_file() && isSource(entry.path())) {
            files.push_back(std::filesystem::relative(entry.path(), root).generic_string());
        }
    }
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> includes(const std::filesystem::path& file) {
    static const std::regex pattern(R"(^\s*#\s*include\s*["<]([^">]+)[">].*)");
    std::vector<std::string> found;
    std::ifstream stream(file);
    std::smatch match;
    for (std::string line; std::getline(stream, line);) {
        if (line.find("include") != std::string::npos && std::regex_match(line, match, pattern)) {
            found.push_back(match[1]);
        }
    }
    return found;
}

using Graph = std::map<std::string, std::vector<std::string>>;  // file -> its includes

// Finds the files of a cycle, in the order in which they include each other, with the first also at
// the end. Empty without a cycle.
class CycleSearch {
public:
    explicit CycleSearch(const Graph& graph) : graph_(graph) {}

    std::vector<std::string> cycle() {
        for (const auto& [file, included] : graph_)
            if (visit(file)) return path_;
        return {};
    }

private:
    bool visit(const std::string& file) {
        if (done_.contains(file)) return false;
        const auto before = std::ranges::find(path_, file);
        const bool closed = before != path_.end();
        if (closed) path_.erase(path_.begin(), before);
        path_.push_back(file);
        if (closed) return true;
        if (const auto found = graph_.find(file); found != graph_.end())
            for (const std::string& included : found->second)
                if (visit(included)) return true;
        path_.pop_back();
        done_.insert(file);
        return false;
    }

    const Graph& graph_;
    std::vector<std::string> path_;
    std::set<std::string> done_;  // files in no cycle
};

TEST(IncludeDirection, HoldsInEverySource) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    for (const std::string_view folder : kFolders) {
        const std::vector<std::string> files = sources(root, folder);
        EXPECT_FALSE(files.empty()) << folder;
        for (const std::string& file : files) {
            for (const std::string& include : includes(root / file)) {
                for (const Rule& rule : kRules) {
                    EXPECT_FALSE(breaks(rule, file, include)) << file << " includes " << include;
                }
            }
        }
    }
}

TEST(IncludeDirection, PointsDownWithinBenchmarks) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    for (const std::string& file : sources(root, "benchmarks")) {
        const auto layer = layerOf(file);
        EXPECT_TRUE(layer || file == "benchmarks/main.cpp") << file << " is in no layer";
        if (!layer) continue;
        for (const std::string& include : includes(root / file)) {
            const auto below = layerOf(include);
            EXPECT_LE(below.value_or(0), *layer) << file << " includes " << include;
        }
    }
}

TEST(IncludeDirection, LeavesTheSystemToOneFolder) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    for (const std::string_view folder : {"engine", "hair", "benchmarks", "shaders"}) {
        for (const std::string& file : sources(root, folder)) {
            if (file.starts_with(kSystemFolder)) continue;
            std::ifstream stream(root / file);
            const std::string text{std::istreambuf_iterator<char>(stream), {}};
            EXPECT_THAT(systemThingsIn(text), testing::IsEmpty()) << file;
        }
    }
}

TEST(IncludeDirection, FindsTheSystemInAText) {
    using testing::ElementsAre;
    EXPECT_THAT(
        systemThingsIn(
            "#include <vector>\n  # include <unistd.h>  // close\n#include <sys/stat.h>"),
        ElementsAre("unistd.h", "sys/stat.h"));
    EXPECT_THAT(
        systemThingsIn("#include <windows.h>\n#include <linux/perf_event.h>\n#include <winbase.h>"),
        ElementsAre("windows.h", "linux/perf_event.h", "winbase.h"));
    EXPECT_THAT(
        systemThingsIn("std::ifstream file(\"/proc/cpuinfo\");\nopen(\"/sys/class/powercap\")"),
        ElementsAre("/proc", "/sys/"));
    EXPECT_THAT(
        systemThingsIn("#include \"engine/system/process.h\"\n#include <system_error>\n"
                       "return \"/simulation/substeps\";  // as /proc/stat has it\n"),
        testing::IsEmpty());
    // The folder has what the rule keeps out of others. A rename would switch the rule off.
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    std::ifstream stream(root / kSystemFolder / "files_linux.cpp");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_THAT(systemThingsIn(text), testing::IsSupersetOf({"unistd.h", "sys/stat.h", "/proc"}));
}

// Relative includes would escape the rules.
TEST(IncludeDirection, NamesOurFilesFromTheRepository) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    for (const std::string_view folder : kFolders) {
        for (const std::string& file : sources(root, folder)) {
            for (const std::string& include : includes(root / file)) {
                EXPECT_FALSE(include.starts_with(".")) << file << " includes " << include;
                const auto beside = (root / file).parent_path() / include;
                EXPECT_FALSE(std::filesystem::exists(beside)) << file << " includes " << include;
            }
        }
    }
}

// Each `except` and each folder must name existing files. Otherwise a rename would switch off its
// rule.
TEST(IncludeDirection, RulesNameWhatExists) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    for (const Rule& rule : kRules) {
        EXPECT_TRUE(std::filesystem::exists(root / rule.folder)) << rule.folder;
        if (rule.except != "none") {
            const std::string_view folder = rule.except.substr(0, rule.except.find('/'));
            const auto files = sources(root, folder);
            EXPECT_TRUE(std::ranges::any_of(files, [&](const std::string& file) {
                return file.starts_with(rule.except);
            })) << rule.except;
        }
    }
}

TEST(IncludeDirection, HasNoCycle) {
    const std::filesystem::path root = HAIRBENCH_SOURCE_DIR;
    Graph graph;
    for (const std::string_view folder : kFolders)
        for (const std::string& file : sources(root, folder)) graph[file] = includes(root / file);
    EXPECT_THAT(CycleSearch(graph).cycle(), testing::IsEmpty());
}

TEST(IncludeDirection, FindsACycle) {
    const auto cycle = [](const Graph& graph) { return CycleSearch(graph).cycle(); };
    using testing::ElementsAre;
    EXPECT_THAT(
        cycle({{"a.h", {"b.h", "d.h"}}, {"b.h", {"c.h"}}, {"c.h", {"d.h", "b.h"}}, {"d.h", {}}}),
        ElementsAre("b.h", "c.h", "b.h"));
    EXPECT_THAT(cycle({{"a.h", {"a.h"}}}), ElementsAre("a.h", "a.h"));
    // Two paths to one file are no cycle.
    EXPECT_THAT(
        cycle({{"a.h", {"b.h", "c.h"}}, {"b.h", {"d.h"}}, {"c.h", {"d.h", "vector"}}, {"d.h", {}}}),
        testing::IsEmpty());
}

TEST(IncludeDirection, RuleCatchesABreachAndKnowsItsException) {
    const Rule rule{"hair/", "nlohmann/", "hair/groom/mesh/gltf_model.cpp"};
    EXPECT_TRUE(breaks(rule, "hair/settings.h", "nlohmann/json.hpp"));
    EXPECT_FALSE(breaks(rule, "hair/groom/mesh/gltf_model.cpp", "nlohmann/json.hpp"));
    EXPECT_FALSE(breaks(rule, "benchmarks/scene/scene.cpp", "nlohmann/json.hpp"));
    EXPECT_FALSE(breaks(rule, "hair/settings.cpp", "hair/fields.h"));
}

TEST(IncludeDirection, LeavesReferencesToTests) {
    const auto broken = [](std::string_view file) {
        return std::ranges::any_of(
            kRules, [&](const Rule& rule) { return breaks(rule, file, "hair/reference/rod.h"); });
    };
    EXPECT_TRUE(broken("hair/simulation/solver_rod.cpp"));
    EXPECT_TRUE(broken("hair/settings.h"));
    EXPECT_TRUE(broken("benchmarks/physics/theory.cpp"));
    EXPECT_TRUE(broken("engine/device.h"));
    EXPECT_FALSE(broken("hair/reference/ftl.cpp"));
    EXPECT_FALSE(broken("tests/simulation/gpu_rod_test.cpp"));
}

}  // namespace
