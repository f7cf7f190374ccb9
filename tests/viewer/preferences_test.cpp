#include "benchmarks/viewer/preferences.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "engine/error.h"

namespace benchmarks::viewer {
namespace {

class PreferencesFiles : public testing::Test {
protected:
    PreferencesFiles() { std::filesystem::remove_all(folder_); }
    ~PreferencesFiles() override { std::filesystem::remove_all(folder_); }

    std::string text() const {
        std::ostringstream text;
        text << std::ifstream(file_).rdbuf();
        return text.str();
    }
    void write(const std::string& text) const {
        std::filesystem::create_directories(file_.parent_path());
        std::ofstream(file_) << text;
    }

    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / "hairbench_preferences";
    std::filesystem::path file_ = folder_ / "new" / "viewer.json";
};

Preferences other() {
    return {
        .theme = Theme::light,
        .zoom = 1.25f,
        .left = {.width = 33.0f, .shown = false},
        .right = {.width = 18.5f},
        .width = 1111,
        .height = 777,
        .present_mode = engine::PresentMode::immediate,
        .recent = {"/scenes/a.json", "/scenes/b c.json"}};
}

TEST(Preferences, ReadBackAsTheyWere) {
    EXPECT_EQ(readPreferences(preferencesText(other())), other());
    EXPECT_EQ(readPreferences(preferencesText({})), Preferences{});
}

TEST(Preferences, TakeWhatATextLacksFromTheFirstTime) {
    EXPECT_EQ(readPreferences("{}"), Preferences{});
    Preferences light;
    light.theme = Theme::light;
    EXPECT_EQ(readPreferences(R"({"theme": "light", "later": [1]})"), light);
}

TEST(Preferences, IgnoreWhatCantBe) {
    for (const char* const text :
         {R"({"theme": "pink"})", R"({"theme": 1})", R"({"zoom": 0})", R"({"zoom": 1e9})",
          R"({"zoom": "large"})", R"({"left": 4})", R"({"left": {"width": -1, "shown": "yes"}})",
          R"({"window": {"width": 1, "height": 1e12}})", R"({"present_mode": "often"})",
          R"({"recent": "a.json"})", R"({"recent": [1, null]})"})
        EXPECT_EQ(readPreferences(text), Preferences{}) << text;
}

TEST(Preferences, RefuseWhatIsNoObject) {
    for (const char* const text : {"", "{", "[]", "3", "\xff", "{} {}"})
        EXPECT_THROW(readPreferences(text), engine::Error) << text;
}

TEST(Preferences, RememberEachSceneOnce) {
    Preferences preferences;
    for (const char* const scene : {"/a.json", "/b.json", "/x/../a.json"})
        remember(preferences, scene);
    EXPECT_EQ(preferences.recent, (std::vector<std::filesystem::path>{"/a.json", "/b.json"}));
    for (int i = 0; i < 50; ++i) remember(preferences, "/" + std::to_string(i));
    EXPECT_EQ(preferences.recent.size(), kMostRecent);
    EXPECT_EQ(preferences.recent.front(), "/49");
}

TEST(Preferences, AreWhereTheDesktopKeepsThem) {
    const auto with = [](const char* config, const char* home) {
        config ? setenv("XDG_CONFIG_HOME", config, 1) : unsetenv("XDG_CONFIG_HOME");
        home ? setenv("HOME", home, 1) : unsetenv("HOME");
        return usersPreferences();
    };
    const char* const home = std::getenv("HOME");
    const char* const config = std::getenv("XDG_CONFIG_HOME");
    const std::string kept_home = home ? home : "", kept_config = config ? config : "";
    EXPECT_EQ(with("/c", "/h"), "/c/hairbench/viewer.json");
    EXPECT_EQ(with(nullptr, "/h"), "/h/.config/hairbench/viewer.json");
    EXPECT_EQ(with("", "/h"), "/h/.config/hairbench/viewer.json");
    EXPECT_EQ(with("relative", "/h"), "/h/.config/hairbench/viewer.json");
    EXPECT_EQ(with(nullptr, nullptr), std::nullopt);
    with(config ? kept_config.c_str() : nullptr, home ? kept_home.c_str() : nullptr);
}

TEST_F(PreferencesFiles, AreKeptFromOneTimeToTheNext) {
    PreferencesFile first(file_);
    EXPECT_EQ(first.now, Preferences{});
    first.now = other();
    first.keep();
    EXPECT_EQ(first.problem(), "");
    EXPECT_EQ(PreferencesFile(file_).now, other());
}

TEST_F(PreferencesFiles, AreNotWrittenWhereNothingChanged) {
    PreferencesFile file(file_);
    file.keep();
    EXPECT_FALSE(std::filesystem::exists(file_));
    write("{}");
    PreferencesFile same(file_);
    same.keep();
    EXPECT_EQ(text(), "{}");
}

TEST_F(PreferencesFiles, WithoutAPathAreNotKept) {
    PreferencesFile file({});
    file.now = other();
    file.keep();
    EXPECT_EQ(file.problem(), "");
}

TEST_F(PreferencesFiles, ThatAreBrokenAreSaidToBeAndReplaced) {
    write("{\"theme\": ");
    PreferencesFile file(file_);
    EXPECT_EQ(file.now, Preferences{});
    EXPECT_NE(file.problem().find("ignored"), std::string::npos);
    EXPECT_EQ(file.problem().find('\n'), std::string::npos);
    file.now.zoom = 2.0f;
    file.keep();
    EXPECT_EQ(PreferencesFile(file_).now.zoom, 2.0f);
}

TEST_F(PreferencesFiles, ThatCantBeWrittenAreAProblemOnce) {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "new") << "a file where the folder would be";
    PreferencesFile file(file_);
    file.now = other();
    file.keep();
    EXPECT_NE(file.problem().find("not kept"), std::string::npos);
    EXPECT_EQ(file.problem().find('\n'), std::string::npos);
}

}  // namespace
}  // namespace benchmarks::viewer
