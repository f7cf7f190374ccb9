// Tests `hairbench simulate` as a user runs it.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run_hairbench.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SimulateCli : public testing::Test {
protected:
    void SetUp() override {
        if (hairbench("devices").status != 0) return skipWithout(Need::device, "no Vulkan device");
    }

    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "'";
    }
    Outcome simulate(std::string_view out, const std::string& options = "") const {
        return hairbench(
            "simulate '" HAIRBENCH_SCENES_DIR "/smoke.json' " + options + " --export " +
            quoted(out));
    }

    TemporaryFolder folder_;
};

// The same program with stiffer hair moves it otherwise: by how much is seen, not only that hashes
// differ. With a threshold above the change, it passes.
TEST_F(SimulateCli, GateFindsHairThatMovesOtherwise) {
    const std::string program = "'" HAIRBENCH_PROGRAM "'";
    const std::string small = "--set /strands/density=1 --set /render/width=64 "
                              "--set /render/height=36 --set /run/frames=20 ";
    const std::string without = "gate --probes --a " + program + " --b " + program + " --scene " +
                                shippedScene("smoke.json") + "--axis /render/msaa=1 " + small +
                                "--out " + quoted("gate.json");
    const std::string gate = without + " --set /run/probes/tip_displacement=true";
    const Outcome same = hairbench(gate);
    EXPECT_EQ(same.status, 0) << same.output;
    EXPECT_THAT(same.output, HasSubstr("0 regressed, 0 improved, 5 same, 0 inconclusive"));
    const std::string stiffer = " --set-b /simulation/local/stiffness=0.2";
    const Outcome other = hairbench(gate + stiffer + " --threshold 1%");
    EXPECT_EQ(other.status, 12) << other.output;
    EXPECT_THAT(other.output, testing::ContainsRegex("probe.tip_displacement.mean .* mismatch"));
    EXPECT_EQ(hairbench(gate + stiffer + " --threshold 90%").status, 0);
    EXPECT_THAT(textOf(folder_.file("gate.json")), HasSubstr("\"verdict\": \"same\""));
    const Outcome none = hairbench(without);
    EXPECT_EQ(none.status, 14) << none.output;
    EXPECT_THAT(none.output, HasSubstr("no probe in common: see /run/probes"));
}

// There are 136 root triangles with 16 strands each, and 7 segments with 2 pieces each.
TEST_F(SimulateCli, WritesTheSameStrandsInEveryFormat) {
    const Outcome moving = simulate("hair.usda", "--frames 3");
    EXPECT_EQ(moving.status, 0) << moving.output;
    EXPECT_THAT(moving.output, HasSubstr("2176 strands, 32640 points, frames 0 to 2 of smoke"));
    for (const char* name : {"hair.hair", "hair.obj"}) {
        const Outcome last = simulate(name, "--frames 3");
        EXPECT_EQ(last.status, 0) << last.output;
        EXPECT_THAT(last.output, HasSubstr("32640 points, frame 2, the last, of smoke"));
    }
    if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    const Outcome compared = runPython(
        "tests/cli/compare_frames.py",
        "3 " + quoted("hair.usda") + ' ' + quoted("hair.hair") + ' ' + quoted("hair.obj"));
    EXPECT_EQ(compared.output, "2176 strands, 32640 points are equal\n");
}

// Each case of a sweep has an array of its own, as numpy.load() maps it: as many frames as were
// played, and the same guides as in the formats of hair.
TEST_F(SimulateCli, WritesAnArrayForEachCase) {
    const std::string options = "--frames 3 --guides --axis /render/msaa=1 "
                                "--axis /simulation/wind/strength=0,20 ";
    const Outcome swept = simulate("sim_{case}.npy", options);
    EXPECT_EQ(swept.status, 0) << swept.output;
    EXPECT_THAT(swept.output, HasSubstr("86 strands, 688 points, frames 0 to 2 of smoke/msaa:1"));
    const Outcome last = simulate(
        "last.obj", "--frames 3 --guides --set /render/msaa=1 --set /simulation/wind/strength=20");
    EXPECT_EQ(last.status, 0) << last.output;
    const std::string array = textOf(folder_.file("sim_msaa-1_strength-20.npy"));
    const std::string still = textOf(folder_.file("sim_msaa-1_strength-0.npy"));
    // Format 1.0: 128 bytes of header, in which the version and the length are binary.
    ASSERT_EQ(array.size(), 128 + 3 * 688 * 3 * sizeof(float));
    ASSERT_EQ(still.size(), array.size());
    EXPECT_EQ(array.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
    EXPECT_THAT(
        array, HasSubstr("{'descr': '<f4', 'fortran_order': False, 'shape': (3, 86, 8, 3), }"));
    EXPECT_EQ(array[127], '\n');
    EXPECT_NE(array.substr(128), still.substr(128));
    std::vector<float> points(688 * 3);
    std::memcpy(points.data(), array.data() + array.size() - points.size() * 4, points.size() * 4);
    std::istringstream obj(textOf(folder_.file("last.obj")));
    std::size_t read = 0;
    for (std::string line; std::getline(obj, line);) {
        if (!line.starts_with("v ")) continue;
        std::istringstream numbers(line.substr(2));
        for (float number; numbers >> number; ++read) {
            ASSERT_LT(read, points.size());
            EXPECT_EQ(number, points[read]);  // .obj holds floats exactly
        }
    }
    EXPECT_EQ(read, points.size());
}

// The table has the start of the hair and each frame of both cases.
TEST_F(SimulateCli, WritesProbesOfASweep) {
    const std::string probes = "simulate " + shippedScene("smoke.json") +
                               "--frames 4 --axis /render/msaa=1 "
                               "--axis /simulation/wind/strength=0,20 --probes " +
                               quoted("probes.csv");
    const Outcome swept =
        hairbench(probes + " --set /run/probes/speed=true --set /run/probes/tip_displacement=true");
    EXPECT_EQ(swept.status, 0) << swept.output;
    EXPECT_THAT(swept.output, HasSubstr("5 probes, frames 0 to 4 of 2 cases"));
    std::istringstream table(textOf(folder_.file("probes.csv")));
    std::vector<std::string> lines;
    for (std::string line; std::getline(table, line);) lines.push_back(line);
    ASSERT_EQ(lines.size(), 1u + 2 * 5);
    EXPECT_EQ(
        lines[0],
        "case,frame,probe.time,probe.tip_displacement.mean,probe.tip_displacement.median,"
        "probe.tip_displacement.percentile_90,probe.tip_displacement.maximum,probe.speed");
    EXPECT_TRUE(lines[1].starts_with("\"smoke/msaa:1/strength:0\",0,0,")) << lines[1];
    EXPECT_TRUE(lines[6].starts_with("\"smoke/msaa:1/strength:20\",0,0,")) << lines[6];
    // Both cases settle without wind, so that they start alike.
    EXPECT_EQ(lines[1].substr(lines[1].find(",0,0,")), lines[6].substr(lines[6].find(",0,0,")));
    EXPECT_NE(lines[5].substr(lines[5].find(",4,")), lines[10].substr(lines[10].find(",4,")));
    const Outcome none = hairbench(probes);
    EXPECT_EQ(none.status, 2) << none.output;
    EXPECT_THAT(none.output, HasSubstr("asks for none: see /run/probes"));
    EXPECT_EQ(hairbench("simulate " + shippedScene("smoke.json")).status, 2);
}

// The last frame of a motion as the reference of the same motion: the last distance is 0, and the
// first is that of the last frame from the groom, as still hair of the same guides has it.
TEST_F(SimulateCli, MeasuresDistancesToAFile) {
    const std::string guides = "--frames 3 --guides --set /simulation/settle_steps=0 "
                               "--axis /render/msaa=1 --axis /simulation/wind/strength=20 ";
    const std::string measure = "simulate " + shippedScene("smoke.json") + guides +
                                "--allow-outside --set /run/probes/groom_distance=true --probes " +
                                quoted("p.csv") + " --set /run/probes/reference=";
    for (const std::string name : {"last.ply", "every.abc"}) {
        ASSERT_EQ(simulate(name, guides).status, 0);
        const Outcome measured = hairbench(measure + quoted(name));
        ASSERT_EQ(measured.status, 0) << measured.output;
        std::istringstream table(textOf(folder_.file("p.csv")));
        std::vector<double> means;
        for (std::string line; std::getline(table, line);) {
            std::istringstream cells(line);
            std::string cell;
            for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
            if (line.front() == '"') means.push_back(std::stod(cell));
        }
        ASSERT_EQ(means.size(), 4u);
        EXPECT_GT(means[0], means[1]);
        EXPECT_GT(means[1], means[2]);
        EXPECT_GT(means[2], 0.0);
        EXPECT_EQ(means[3], 0.0) << name;
    }
    const Outcome other = hairbench(measure + quoted("last.ply") + " --set /groom/guides=10");
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(
        other.output, HasSubstr(
                          "/run/probes/reference: " + folder_.file("last.ply").string() +
                          " has 86 strands, and there are 10 guides"));
}

// Probes don't change the motion, and are those of the frames that are written.
TEST_F(SimulateCli, WritesStrandsAndProbesOfTheSameFrames) {
    const std::string options = "--frames 4 --guides --axis /render/msaa=1 "
                                "--axis /simulation/wind/strength=0,20 "
                                "--set /run/probes/tip_displacement=true --set "
                                "/run/probes/speed=true ";
    const std::string scene = "simulate " + shippedScene("smoke.json") + options;
    ASSERT_EQ(hairbench(scene + "--probes " + quoted("alone.csv")).status, 0);
    ASSERT_EQ(hairbench(scene + "--export " + quoted("alone_{case}.npy")).status, 0);
    const Outcome both =
        hairbench(scene + "--export " + quoted("{case}.npy") + " --probes " + quoted("both.csv"));
    ASSERT_EQ(both.status, 0) << both.output;
    EXPECT_EQ(textOf(folder_.file("both.csv")), textOf(folder_.file("alone.csv")));
    for (const std::string name : {"msaa-1_strength-0.npy", "msaa-1_strength-20.npy"})
        EXPECT_EQ(textOf(folder_.file(name)), textOf(folder_.file("alone_" + name))) << name;
}

// Both parts and the filtered cases are those of the whole sweep.
TEST_F(SimulateCli, PlaysPartsOfASweep) {
    const std::string options =
        "--frames 1 --guides --axis /render/msaa=1 --axis /simulation/wind/strength=0,5,20 ";
    const auto files = [&](const std::string& name) {
        std::vector<std::string> found;
        for (const auto& each : fs::directory_iterator(folder_.file(name)))
            found.push_back(each.path().filename().string());
        std::ranges::sort(found);
        return found;
    };
    ASSERT_EQ(simulate("first/{case}.npy", options + "--shard 1/2").status, 0);
    ASSERT_EQ(simulate("second/{case}.npy", options + "--shard 2/2").status, 0);
    ASSERT_EQ(simulate("some/{case}.npy", options + "--filter 'strength:.*0$'").status, 0);
    EXPECT_THAT(
        files("first"), testing::ElementsAre("msaa-1_strength-0.npy", "msaa-1_strength-20.npy"));
    EXPECT_THAT(files("second"), testing::ElementsAre("msaa-1_strength-5.npy"));
    EXPECT_THAT(
        files("some"), testing::ElementsAre("msaa-1_strength-0.npy", "msaa-1_strength-20.npy"));
    EXPECT_EQ(simulate("{case}.npy", options + "--filter nothing").status, 14);
    const Outcome one = simulate("one.npy", options + "--filter strength");
    EXPECT_EQ(one.status, 2);
    EXPECT_THAT(one.output, HasSubstr("--filter: needs {case} in the name of the file"));
}

// The second case fails, because the camera sees other strands as the head nods. Once it is mended,
// only it is played.
TEST_F(SimulateCli, ContinuesASweep) {
    const auto write = [&](const char* near_distance, const char* far_distance) {
        folder_.write(
            "nods.json", std::string(R"({"base": "nod", "strands": {"density": 4},
                "sweep": {"cases": [{"/lod/mode": "forced"},
                    {"/lod/mode": "distance", "/lod/near_distance": )") +
                             near_distance + R"(, "/lod/far_distance": )" + far_distance + "}]}}");
    };
    const std::string command = "simulate " + quoted("nods.json") + " --export " +
                                quoted("{case}.abc") + " --probes " + quoted("probes.csv") +
                                " --set /run/probes/speed=true --frames ";
    const auto files = [&] {
        std::vector<std::string> found;
        for (const auto& each : fs::directory_iterator(folder_.path()))
            found.push_back(each.path().filename().string());
        std::ranges::sort(found);
        return found;
    };
    write("0.3", "0.7");
    const Outcome broken = hairbench(command + "20");
    EXPECT_EQ(broken.status, 2) << broken.output;
    EXPECT_THAT(broken.output, HasSubstr("/lod/mode: "));
    ASSERT_EQ(files().size(), 3u);
    EXPECT_EQ(files()[1], "nods.abc.journal");
    const std::string first = files()[0];
    EXPECT_THAT(first, testing::StartsWith("mode-forced"));
    folder_.write(first, "kept");

    write("10", "20");
    const Outcome other = hairbench(command + "7 --resume");
    EXPECT_EQ(other.status, 2) << other.output;
    EXPECT_THAT(
        other.output, HasSubstr("nods.abc.journal: can't be resumed: its frames is 20, not 7"));
    const Outcome continued = hairbench(command + "20 --resume");
    EXPECT_EQ(continued.status, 0) << continued.output;
    EXPECT_THAT(continued.output, HasSubstr("1 of 2 cases are there already, 1 are played"));
    EXPECT_THAT(continued.output, HasSubstr("1 probes, frames 0 to 20 of 2 cases"));
    ASSERT_EQ(files().size(), 4u);
    EXPECT_EQ(files()[0], "mode-distance_near_distance-10_far_distance-20.abc");
    EXPECT_EQ(textOf(folder_.file(first)), "kept");
    // The hair is the same, so its probes are: those of the journal and those that were played.
    std::istringstream table(textOf(folder_.file("probes.csv")));
    std::vector<std::string> rows;
    for (std::string line; std::getline(table, line);) rows.push_back(line.substr(line.find(',')));
    ASSERT_EQ(rows.size(), 1u + 2 * 21);
    for (std::size_t i = 1; i <= 21; ++i) EXPECT_EQ(rows[i], rows[i + 21]) << i;
    // A part leaves the other's journal alone, and the whole sweep takes no part's.
    write("0.3", "0.7");
    EXPECT_EQ(hairbench(command + "20 --shard 2/2").status, 2);
    EXPECT_EQ(hairbench(command + "20 --shard 1/2").status, 0);
    EXPECT_TRUE(fs::exists(folder_.file("nods_part_2_2.abc.journal")));
    write("10", "20");
    EXPECT_EQ(hairbench(command + "20").status, 0);
    EXPECT_NE(textOf(folder_.file(first)), "kept");
    EXPECT_TRUE(fs::exists(folder_.file("nods_part_2_2.abc.journal")));
    const Outcome one = simulate("one.npy", "--resume");
    EXPECT_EQ(one.status, 2);
    EXPECT_THAT(one.output, HasSubstr("--resume: needs {case} in the name of the file"));
}

TEST_F(SimulateCli, RefusesToSetWhatTheSweepVaries) {
    const Outcome outcome =
        simulate("{case}.npy", "--set /render/msaa=1 --axis /simulation/wind/strength=0");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(
        outcome.output,
        HasSubstr("smoke.json: --set /render/msaa=1: the sweep varies this field; --axis "
                  "/render/msaa=1 replaces its values"));
    const Outcome one = simulate("one.npy", "--axis /simulation/wind/strength=0,5");
    EXPECT_EQ(one.status, 2);
    EXPECT_THAT(
        one.output, HasSubstr("--axis /simulation/wind/strength=0,5: needs {case} in the name"));
}

TEST_F(SimulateCli, WritesTheGuides) {
    const Outcome outcome = simulate("guides.usda", "--frames 1 --guides -a /groom/guides=86");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("86 strands, 688 points, frames 0 to 0"));
    const std::string text = textOf(folder_.file("guides.usda"));
    EXPECT_THAT(text, HasSubstr("hairbench:rootTriangles"));
    EXPECT_THAT(text, testing::Not(HasSubstr("widths")));
}

// Coordinates of the vertices of an .obj file, in order.
std::vector<double> coordinatesOf(const std::string& text) {
    std::vector<double> all;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind != "v") continue;
        for (double number = 0.0; words >> number;) all.push_back(number);
    }
    return all;
}

// A file of guides that play is the motion that was written to it. Its first sample is at time 0,
// and the first frame ends after a time step: so its frame 4 is sample 5.
class PlayedFile : public SimulateCli, public testing::WithParamInterface<std::string> {};

TEST_P(PlayedFile, IsTheMotionThatWasWritten) {
    const std::string file = "guides" + GetParam();
    const std::string guides = "--guides -a /groom/guides=86 ";
    ASSERT_EQ(simulate(file, guides + "--frames 6").status, 0);
    ASSERT_EQ(simulate("expected.obj", guides + "--frames 6").status, 0);
    folder_.write(
        "playing.json", R"({ "groom": { "file": ")" + file + R"(", "cache": { "mode": "play" } },
             "simulation": { "solver": "none" } })");
    const auto play = [&](const std::string& options) {
        return hairbench(
            "simulate " + quoted("playing.json") + " --guides --frames 5 --export " +
            quoted("played.obj") + ' ' + options);
    };
    const Outcome played = play("");
    if (played.output.find("Python environment") != std::string::npos)
        return skipWithout(Need::python, kNoPython);
    ASSERT_EQ(played.status, 0) << played.output;
    const std::vector<double> expected = coordinatesOf(textOf(folder_.file("expected.obj")));
    const std::vector<double> found = coordinatesOf(textOf(folder_.file("played.obj")));
    ASSERT_EQ(found.size(), 3u * 688u);
    ASSERT_EQ(found.size(), expected.size());
    // Times are floats, so a frame is within 1e-6 of the way between two samples.
    for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], expected[i], 1e-6) << i;

    const Outcome moved = play("--set /simulation/solver=shape");
    EXPECT_EQ(moved.status, 2);
    EXPECT_THAT(moved.output, HasSubstr("/groom/cache/mode: is play, which needs"));
    const Outcome followed = play("--set /simulation/solver=shape --set /groom/cache/mode=follow");
    EXPECT_EQ(followed.status, 0) << followed.output;
}

INSTANTIATE_TEST_SUITE_P(
    Formats, PlayedFile, testing::Values(".usda", ".abc"),
    [](const auto& test) { return test.param.substr(1); });

TEST_F(SimulateCli, RefusesAFormatThatItDoesNotKnowBeforeItBegins) {
    const Outcome outcome = simulate("hair.fbx", "--frames 1000000");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("hair.fbx: "));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// The head nods towards the camera. Level of detail by distance then draws other strands.
TEST_F(SimulateCli, RefusesStrandsThatComeAndGo) {
    const Outcome outcome = hairbench(
        "simulate '" HAIRBENCH_SCENES_DIR "/nod.json' --frames 20 -a '/lod/mode=\"distance\"'"
        " -a /lod/near_distance=0.3 -a /lod/far_distance=0.7 --export " +
        quoted("hair.usda"));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.output, HasSubstr("/lod/mode: "));
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// Without job control the shell's children would ignore the interrupt.
TEST_F(SimulateCli, LeavesNoHalfFileWhenItIsInterrupted) {
    const std::string log = quoted("log");
    const fs::path script = folder_.write(
        "interrupt.sh", "set -m\n'" HAIRBENCH_PROGRAM "' simulate '" HAIRBENCH_SCENES_DIR
                        "/smoke.json' --frames 1000000 --export " +
                            quoted("out/hair.usda") + " >" + log +
                            " 2>&1 &\nfor i in $(seq 600); do test -s \"$(compgen -G " +
                            quoted("out/hair.usda.*.partial") +
                            ")\" && break; sleep 0.1; done\nkill -INT $!\nwait $!\n");
    EXPECT_EQ(runInShell("bash '" + script.string() + "'").status, 130);
    EXPECT_THAT(textOf(folder_.file("log")), HasSubstr("interrupted: nothing is written\n"));
    EXPECT_TRUE(fs::is_empty(folder_.file("out")));
}

// Tests invalid outcomes, NaN and impossible strand lengths, in every command that measures or
// writes them.
class WrongOutcome : public SimulateCli {
protected:
    // Writes the smoke scene with these members and one small case.
    std::string scene(const std::string& members) {
        const fs::path file = folder_.write(
            "wrong.json", R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
                "sweep": {}, "groom": {"guides": 40},
                "strands": {"density": 1, "tessellation": 1},
                "run": {"warmup": 2, "frames": 2, "max_time": 0}, )" +
                              members + "}");
        return '\'' + file.string() + "' --allow-outside ";
    }

    void expectRefused(const std::string& command, const std::string& output, const char* reason) {
        const Outcome outcome = hairbench(command);
        EXPECT_NE(outcome.status, 0) << command;
        EXPECT_THAT(outcome.output, testing::ContainsRegex(reason)) << command;
        EXPECT_FALSE(fs::exists(folder_.file(output))) << command;
    }

    void expectNothingIsMade(const std::string& members, const char* reason) {
        const std::string file = scene(members);
        const fs::path report = folder_.file("r.json");
        const Outcome run = hairbench("run " + file + "--no-pictures --out " + quoted("r.json"));
        EXPECT_NE(run.status, 0) << run.output;
        EXPECT_THAT(textOf(report), testing::ContainsRegex("\"status\": *\"failed\""))
            << run.output;
        EXPECT_THAT(textOf(report), testing::ContainsRegex(reason));
        expectRefused("render " + file + "--frame 3 -o " + quoted("a.png"), "a.png", reason);
    }
};

TEST_F(WrongOutcome, OfAForceThatIsNotANumberIsNoMeasurement) {
    folder_.write(
        "force.glsl", "vec3 accelerateGuide(GuidePoint point) { return vec3(0.0 / (point.time - "
                      "point.time)); }\n");
    const char* const members = R"("simulation": {"force": "force.glsl"})";
    const char* const reason = "guide 0, vertex [0-9]+ has no finite position";
    expectNothingIsMade(members, reason);
    for (const char* const name : {"a.usda", "a.obj"})
        expectRefused(
            "simulate " + scene(members) + "--frames 3 --export " + quoted(name), name, reason);
}

TEST_F(WrongOutcome, OfAForceThatTearsHairIsNoMeasurement) {
    folder_.write(
        "force.glsl", "vec3 accelerateGuide(GuidePoint point) { return vec3(0.0, 1e6, 0.0); }\n");
    expectNothingIsMade(
        R"("simulation": {"force": "force.glsl", "length": {"method": "iterate"}})",
        "guide [0-9]+, vertex [0-9]+ is [0-9.e+]+ times as far along it as at rest");
}

// A solver that fails is a case that failed; the other cases of the sweep are measured.
TEST_F(WrongOutcome, OfASolverIsThatOfItsCaseAlone) {
    folder_.write(
        "wrong.glsl", "void solveGuide(Guide guide) { setGuidePosition(1u, vec3(0.0) / "
                      "guideRestLength(0u)); }\n");
    folder_.write("rest.glsl", "void solveGuide(Guide guide) {}\n");
    const fs::path file =
        folder_.write("wrong.json", R"({"base": ")" HAIRBENCH_SCENES_DIR R"(/smoke.json",
            "groom": {"guides": 40}, "strands": {"density": 1, "tessellation": 1},
            "run": {"warmup": 2, "frames": 2, "max_time": 0},
            "sweep": {"/render/msaa": null,
                      "/simulation/solver": ["wrong.glsl", "rest.glsl", "shape"]}})");
    const Outcome run = hairbench(
        "run '" + file.string() + "' --allow-outside --no-pictures --out " + quoted("r.json"));
    EXPECT_EQ(run.status, 0) << run.output;  // the others were measured
    const nlohmann::json cases = nlohmann::json::parse(textOf(folder_.file("r.json"))).at("cases");
    ASSERT_EQ(cases.size(), 3u);
    EXPECT_EQ(cases[0].at("status"), "failed");
    EXPECT_THAT(cases[0].dump(), HasSubstr("vertex 1 has no finite position"));
    EXPECT_EQ(cases[1].at("status"), "ok");
    EXPECT_EQ(cases[2].at("status"), "ok");

    folder_.write("wrong.glsl", "void solveGuide(Guide guide) {\n    gravity();\n}\n");
    const Outcome refused = hairbench("validate '" + file.string() + "' --allow-outside");
    EXPECT_NE(refused.status, 0);
    EXPECT_THAT(
        refused.output,
        testing::ContainsRegex("/simulation/solver: .*wrong.glsl:2: 'gravity' : no matching"));
}

}  // namespace
