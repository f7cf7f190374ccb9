// Tests that the program does nothing with files that strangers made, except to read or refuse
// them.
#include <chrono>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/cli/run_hairbench.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::HasSubstr;

constexpr int kUsage = 2;  // exit status

constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string quoted(const fs::path& path) {
    std::string text = "'";
    for (const char each : path.string()) text += each == '\'' ? "'\\''" : std::string{each};
    return text + "' ";
}

TEST(StrangersScene, OpensNothingOutsideOfItsFolder) {
    const TemporaryFolder folder;
    folder.write("private/head.obj", kTetrahedron);
    const std::string scene = quoted(folder.write(
        "in/s.json", R"({"base": ")" HAIRBENCH_SCENES_DIR
                     R"(/smoke.json", "render": {"meshes": [{"file": "../private/head.obj"}]}})"));
    for (const std::string& command :
         {"validate " + scene, "run --list " + scene,
          "render " + scene + "-o " + quoted(folder.file("p.png")), "lod " + scene,
          "simulate " + scene + "--export " + quoted(folder.file("s.hgl")),
          "export " + scene + "--mitsuba " + quoted(folder.file("m"))}) {
        const Outcome outcome = hairbench(command);
        EXPECT_EQ(outcome.status, kUsage) << command << '\n' << outcome.output;
        EXPECT_THAT(
            outcome.output, AllOf(
                                HasSubstr("/render/meshes/0/file: "), HasSubstr("is outside"),
                                HasSubstr("--allow-outside")))
            << command;
    }
    const Outcome allowed = hairbench("validate --allow-outside " + scene);
    EXPECT_EQ(allowed.status, 0) << allowed.output;
    EXPECT_EQ(hairbench("run --list --allow-outside " + scene).status, 0);
}

// Other programs read meshes and USD.
TEST(StrangersNames, AreNotRunByAShell) {
    const TemporaryFolder folder;
    const std::string trap = ";touch PWNED;`touch PWNED`$(touch PWNED)'\"\n&|x";
    for (const std::string& name : {trap + ".obj", "-h" + trap + ".obj", trap + ".usda"}) {
        const fs::path file = folder.write(name, kTetrahedron);
        const std::string in_folder = "cd " + quoted(folder.path()) + "&& ";
        hairbench("groom info ./" + quoted(file.filename()), in_folder);
        std::string escaped;
        for (const char each : name)
            escaped += each == '"' ? "\\\"" : each == '\n' ? "\\n" : std::string{each};
        folder.write(
            "s.json", R"({"base": ")" HAIRBENCH_SCENES_DIR
                      R"(/smoke.json", "render": {"meshes": [{"file": ")" +
                          escaped + "\"}]}}");
        const Outcome outcome = hairbench("validate s.json", in_folder);
        EXPECT_EQ(outcome.status, name.ends_with(".obj") ? 0 : kUsage) << outcome.output;
        EXPECT_FALSE(fs::exists(folder.file("PWNED"))) << name;
    }
}

// If --filter used std::regex, a signal would end the program here.
TEST(StrangersNames, MatchExpressionsOfAnyKind) {
    const TemporaryFolder folder;
    const std::string value(200'000, 'a');
    folder.write(
        "s.json", R"({"base": ")" HAIRBENCH_SCENES_DIR
                  R"(/smoke.json", "sweep": {"/description": ["x", ")" +
                      value + "\"]}}");
    for (const char* filter : {"(.|x)*c$", "^(([a-z])+.)+[A-Z]([a-z])+$"}) {
        const Outcome outcome = hairbench(
            std::string("run --list --filter '") + filter + "' s.json",
            "cd " + quoted(folder.path()) + "&& ");
        EXPECT_LT(outcome.status, 128) << outcome.output.substr(0, 500);
    }
}

// Without this check, the program would wait for a pipe's reader after all the work. A folder can't
// be written.
TEST(OutputFiles, ArePlainOnesOrRefusedAtOnce) {
    const TemporaryFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe.json").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo(folder.file("pipe.png").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo(folder.file("pipe.hgl").c_str(), 0600), 0);
    fs::create_symlink("round.json", folder.file("round.json"));
    fs::create_directory(folder.file("folder.json"));
    const std::string scene = shippedScene("smoke.json");
    const std::string hair = shippedScene("truth/cantilever.obj");
    const auto out = [&](const std::string& name) { return quoted(folder.file(name)); };
    for (const std::string& command :
         {"run " + scene + "--out " + out("pipe.json"),
          "run " + scene + "--out " + out("round.json"),
          "run " + scene + "--out " + out("folder.json"),
          "run " + scene + "--out " + out(std::string(300, 'n')),
          "render " + scene + "-o " + out("pipe.png"), "lod " + scene + "-o " + out("pipe.json"),
          "ablate " + scene + "-o " + out("pipe.json"),
          "simulate " + scene + "--export " + out("pipe.hgl"),
          "groom convert " + hair + out("pipe.hgl"), "doctor -o " + out("pipe.json"),
          "physics --check catenary --out " + out("pipe.json")}) {
        const Outcome outcome = hairbench(command, "timeout -s KILL 60 ");
        EXPECT_EQ(outcome.status, kUsage) << command << '\n' << outcome.output;
    }
}

// Two files of each kind except journals, which need a device; scripts/test --fuzz has more.
TEST(CraftedFiles, TakeNothingAndOpenNothingOutside) {
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    const std::string slack = " --slack 10";
#else
    const std::string slack;
#endif
    const Outcome outcome = runPython(
        "tests/fuzz/crafted_files.py",
        "'" HAIRBENCH_PROGRAM "' --count 26 --without journal" + slack);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("26 files, 0 faults"));
}

}  // namespace
