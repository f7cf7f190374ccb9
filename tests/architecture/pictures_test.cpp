// Tests that the committed pictures name the commands that drew them, and are those of
// scripts/pictures.
#include <cstdint>
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

// A report that is measured anew gets another name.
TEST(Pictures, AreDrawnFromFilesThatAreThere) {
    static const std::regex file(R"(\{pictures\}/(\S+))");
    const Json all = rows();
    for (const auto& [name, commands] : all.items())
        for (const Json& each : commands) {
            const auto command = each.get<std::string>();
            for (std::sregex_iterator found(command.begin(), command.end(), file), end;
                 found != end; ++found) {
                const std::string path = (*found)[1];
                if (path.find('*') == std::string::npos) {
                    EXPECT_TRUE(fs::exists(kPictures / path)) << name << ": " << path;
                }
            }
        }
}

// This picture takes ninety minutes to draw, and is older than the texts that name a picture's
// commands.
const std::string kOlder = "shading_models_path_traced.png";

// A program of an unmodified commit drew each picture with today's commands.
TEST(Pictures, NameTheCommitAndTheCommands) {
    static const std::regex version(R"(hairbench [0-9.]+ \([0-9a-f]{12}\): )");
    const Json all = rows();
    for (const auto& [name, commands] : all.items()) {
        if (name == kOlder) continue;
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

// A WebP with metadata begins with a VP8X chunk. Its last six bytes are width and height less one:
// RFC 9649, section 2.7.
TEST(Pictures, OfTheGalleryAreAsLargeAsAScreenAndSmallToLoad) {
    const auto number = [](const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        for (int i = 2; i >= 0; --i)
            value = value << 8 | static_cast<std::uint8_t>(bytes.at(at + i));
        return value;
    };
    int count = 0;
    const std::string page = bytesOf(fs::path(HAIRBENCH_SOURCE_DIR) / "docs/gallery.md");
    const Json all = rows();
    for (const auto& [name, commands] : all.items()) {
        if (!name.starts_with("gallery_")) continue;
        SCOPED_TRACE(name);
        const std::string bytes = bytesOf(kPictures / name);
        EXPECT_LT(bytes.size(), 400'000u);
        ASSERT_EQ(bytes.substr(8, 8), "WEBPVP8X");
        EXPECT_EQ(number(bytes, 24), 1919u);
        EXPECT_EQ(number(bytes, 27), 1079u);
        EXPECT_NE(page.find("results/pictures/" + name), std::string::npos);
        // The page has the command that draws it, with another output file.
        std::string command = commands.at(0).get<std::string>();
        command = command.substr(0, command.find(" -o "));
        EXPECT_NE(page.find(command + " -o "), std::string::npos) << command;
        ++count;
    }
    EXPECT_GE(count, 8);
}

}  // namespace
