// A separate process reads each damaged mesh or picture. Neither this process nor any that it
// starts may end by a signal, or take more than 10 s of processor time or 1 GB.
#include <cstdlib>
#include <iostream>
#include <map>
#include <vector>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/float_pictures.h"
#include "engine/pictures.h"
#include "hair/groom/files.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/groom/formats/mutations.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

namespace fs = std::filesystem;

struct Seed {
    std::string name;  // with the extension that selects the reader
    std::string bytes;
};

// Two triangles with texture coordinates and a material, as assimp writes it in each format.
std::vector<Seed> assimpSeeds(const TemporaryFolder& folder) {
    folder.write("m.mtl", "newmtl skin\nKd 0.5 0.25 0.125\n");
    const fs::path source = folder.write(
        "m.obj",
        "mtllib m.mtl\no patch\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
        "vt 0 1\nusemtl skin\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
    Assimp::Importer importer;
    const aiScene* const scene = importer.ReadFile(source.string(), 0);
    EXPECT_NE(scene, nullptr);
    std::vector<Seed> seeds{{"m.obj", textOf(source)}};
    const std::pair<const char*, const char*> formats[] = {
        {"ply", "ascii.ply"}, {"plyb", "binary.ply"}, {"stl", "ascii.stl"}, {"stlb", "binary.stl"},
        {"fbxa", "m.fbx"},    {"collada", "m.dae"},   {"glb2", "m.glb"}};
    for (const auto& [format, name] : formats) {
        Assimp::Exporter exporter;
        const aiExportDataBlob* const blob = scene ? exporter.ExportToBlob(scene, format) : nullptr;
        EXPECT_NE(blob, nullptr) << format;
        if (blob) seeds.push_back({name, {static_cast<const char*>(blob->data), blob->size}});
    }
    seeds.push_back({"m.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"});
    return seeds;
}

std::vector<Seed> seeds(const TemporaryFolder& folder) {
    std::vector<Seed> all = assimpSeeds(folder);
    all.push_back({"corpus.glb", textOf(corpus("gltf/trimesh_head_and_lines.glb"))});
    for (const char* name : {"strand_bands.png", "taper_lengths.png", "studio.exr"})
        all.push_back({name, textOf(fs::path(HAIRBENCH_SCENES_DIR) / "assets" / name)});
    // Radiance: two rows of eight pixels, the second run-length encoded.
    std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n";
    for (int row = 0; row < 2; ++row) {
        hdr.append("\x02\x02\x00\x08", 4);
        for (int channel = 0; channel < 4; ++channel)
            hdr.append(
                row == 0 ? std::string(
                               "\x08"
                               "abcdefgh",
                               9)
                         : std::string("\x88z", 2));
    }
    all.push_back({"sky.hdr", hdr});
    return all;
}

// Runs in a child.
void read(const fs::path& path) {
    const std::string extension = lowerCaseExtension(path);
    if (extension == ".png")
        engine::readImage(path);
    else if (extension == ".exr" || extension == ".hdr")
        engine::readFloatImage(path);
    else
        importMesh(path, Textures::decoded);
}

struct Reading {
    int status;  // of waitpid()
    double seconds;  // s of processor time
    long kilobytes;  // peak memory
};

Reading readApart(const fs::path& path) {
    const pid_t child = fork();
    if (child == 0) {
        alarm(100);  // ends a process that waits forever
        try {
            read(path);
        } catch (const engine::Error&) {
            _exit(1);
        } catch (...) {
            _exit(2);
        }
        _exit(0);
    }
    Reading reading{};
    rusage use{};
    wait4(child, &reading.status, 0, &use);  // including that of its children
    reading.seconds = static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
                      1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
    reading.kilobytes = use.ru_maxrss;
    return reading;
}

void readMutated(std::uint32_t count) {
    const TemporaryFolder folder;
    const std::vector<Seed> all = seeds(folder);
    for (const Seed& seed : all) {
        const Reading whole = readApart(folder.write(seed.name, seed.bytes));
        EXPECT_EQ(whole.status, 0) << seed.name;  // otherwise none of its mutations would be tested
    }
    std::map<int, std::uint32_t> statuses;
    double longest = 0.0;
    long most = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        Dice dice(i);
        const Seed& seed = all[i % all.size()];
        const std::string& other = all[dice.below(all.size())].bytes;
        std::string bytes = seed.bytes;
        for (std::uint32_t k = 0; k <= dice.below(4); ++k) bytes = mutated(bytes, other, dice);
        const Reading reading = readApart(folder.write(seed.name, bytes));
        ++statuses[reading.status];
        longest = std::max(longest, reading.seconds);
        most = std::max(most, reading.kilobytes);
        EXPECT_TRUE(WIFEXITED(reading.status) && WEXITSTATUS(reading.status) < 2)
            << seed.name << ", mutation " << i << ": status " << reading.status;
        EXPECT_LT(reading.seconds, 10.0) << seed.name << ", mutation " << i;
        EXPECT_LT(reading.kilobytes, 1'000'000) << seed.name << ", mutation " << i;
    }
    for (const auto& [status, times] : statuses)
        std::cout << times << " with status " << WEXITSTATUS(status)
                  << (WIFSIGNALED(status) ? " by a signal" : "") << '\n';
    std::cout << "longest " << longest << " s, most " << most / 1000 << " MB\n";
}

TEST(MeshMutations, AreRefusedOrRead) { readMutated(150); }

// HAIRBENCH_MUTATIONS=5000 test_formats --gtest_filter='MeshMutations.*'
TEST(MeshMutations, AreRefusedOrReadHoweverMany) {
    const char* const count = std::getenv("HAIRBENCH_MUTATIONS");
    if (!count) GTEST_SKIP() << "HAIRBENCH_MUTATIONS says how many";
    readMutated(static_cast<std::uint32_t>(std::atoi(count)));
}

}  // namespace
}  // namespace hair::groom
