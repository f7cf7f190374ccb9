// The committed pictures say what drew them, and are those that scripts/pictures draws.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;

using Json = nlohmann::ordered_json;

const fs::path kPictures = fs::path(HAIRBENCH_SOURCE_DIR) / "results/pictures";

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Json rows() { return Json::parse(bytesOf(kPictures / "pictures.json")); }

TEST(Pictures, AreThoseThatTheScriptDraws) {
    std::set<std::string> drawn;
    const Json all = rows();
    for (const auto& [name, commands] : all.items()) drawn.insert(name);
    std::set<std::string> committed;
    for (const auto& entry : fs::directory_iterator(kPictures))
        if (entry.path().extension() != ".json") committed.insert(entry.path().filename().string());
    EXPECT_EQ(committed, drawn);
}

// Minutes or hours of drawing each, and drawn before pictures named what drew them.
const std::set<std::string> kOlder{
    "portrait_braid.png",
    "portrait_curls.png",
    "portrait_fringe.png",
    "portrait_layers.png",
    "portrait_layers_back.png",
    "portrait_wind_film.png",
    "shading_models_path_traced.png"};

// A program of a commit, without changes, by the commands of today.
TEST(Pictures, NameTheCommitAndTheCommands) {
    static const std::regex version(R"(hairbench [0-9.]+ \([0-9a-f]{12}\): )");
    const Json all = rows();
    for (const auto& [name, commands] : all.items()) {
        if (kOlder.contains(name)) continue;
        const std::string bytes = bytesOf(kPictures / name);
        std::string said;
        for (const Json& command : commands)
            said += (said.empty() ? "" : "; ") + command.get<std::string>();
        const std::size_t at = bytes.find(said);
        ASSERT_NE(at, std::string::npos) << name << " was not drawn by " << said;
        std::smatch match;
        const std::string before = bytes.substr(at < 40 ? 0 : at - 40, at < 40 ? at : 40);
        EXPECT_TRUE(std::regex_search(before, match, version) && match.suffix().length() == 0)
            << name;
    }
}

}  // namespace
