#include <map>

#include <gmock/gmock.h>

#include "tests/groom/formats/broken_promise.h"
#include "tests/groom/formats/strand_files.h"
#include "tests/python.h"

// tests/corpus/README.md gives the origin of the files.
namespace hair::groom {
namespace {

namespace fs = std::filesystem;

// Every valid file of the corpus and how many strands it has.
const std::map<std::string, std::uint32_t> kStrands{
    {"abc/alembic_cubic.abc", 3},
    {"abc/alembic_groom.abc", 3},
    {"abc/alembic_objects.abc", 3},
    {"abc/blender_catmull_rom.abc", 3},
    {"abc/blender_groups.abc", 6},
    {"abc/blender_poly.abc", 3},
    {"bin/short_and_nan.bin", 1},
    {"bin/two_strands.bin", 2},
    {"data/empty_strand.data", 2},
    {"data/three_strands.data", 3},
    {"gltf/blender_draco.glb", 3},
    {"gltf/blender_plain.glb", 3},
    {"gltf/lines.gltf", 3},
    {"gltf/meshopt.gltf", 3},
    {"gltf/strips.gltf", 3},
    {"gltf/trimesh_head_and_lines.glb", 3},
    {"gltf/trimesh_lines.glb", 3},
    {"hair/all_arrays.hair", 3},
    {"hair/points_only.hair", 2},
    {"hair/segments_and_colors.hair", 3},
    {"hair/reported_one_point.hair", 11},
    {"hgl/no_triangles.hgl", 2},
    {"hgl/one_guide.hgl", 1},
    {"hgl/three_guides.hgl", 3},
    {"mitshair/binary.mitshair", 3},
    {"mitshair/comments.txt", 3},
    {"mitshair/radii.txt", 3},
    {"npy/doubles_fortran.npy", 1},
    {"npy/two_strands.npy", 2},
    {"npz/difflocks.npz", 2},
    {"npz/difflocks_deflated.npz", 2},
    {"npz/groups_and_guides.npz", 2},
    {"obj/segments.obj", 3},
    {"obj/vtk_lines.obj", 3},
    {"other_hair/monohair.hair", 3},
    {"pbrt/bezier.pbrt", 2},
    {"pbrt/bspline.pbrt", 2},
    {"ply/plyfile_edges_ascii.ply", 3},
    {"ply/plyfile_edges_big.ply", 3},
    {"ply/plyfile_edges_little.ply", 3},
    {"ply/plyfile_strands_ascii.ply", 3},
    {"ply/plyfile_strands_big.ply", 3},
    {"ply/plyfile_strands_little.ply", 3},
    {"tfx/all_arrays.tfx", 2},
    {"tfx/positions_only.tfx", 2},
    {"tfx/version_2.tfx", 2},
    {"tfx/version_3.tfx", 2},
    {"usd/bezier.usda", 2},
    {"usd/blender_centimetres.usda", 6},
    {"usd/blender_groups.usda", 6},
    {"usd/blender_groups.usdc", 6},
    {"usd/linear.usda", 3},
    {"usd/reported_guides_flag.usda", 6},
    {"usd/reported_half_width.usda", 2},
    {"usd/reported_invisible.usda", 2},
    {"usd/reported_pinned_varying.usda", 1},
    {"usd/reported_seq.usda", 2},
    {"usd/reported_st_vertex.usda", 2},
    {"usd/reported_up_stated.usda", 4},
    {"usd/reported_usd_width1.usda", 2},
    {"xml/cubic.xml", 4},
    {"xml/linear.xml", 3},
};

// Files in the folders of formats, relative to `folder`, except files directly in `folder`.
std::vector<std::string> filesIn(const fs::path& folder) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path name = entry.path().lexically_relative(folder);
        const bool is_in_format = name.has_parent_path() && *name.begin() != "findings";
        if (entry.is_regular_file() && is_in_format) files.push_back(name.generic_string());
    }
    return files;
}

TEST(Corpus, ValidFilesHaveTheirStrands) {
    std::vector<std::string> expected;
    for (const auto& [name, strands] : kStrands) {
        expected.push_back(name);
        if (name.starts_with("usd/") && pythonInterpreter().empty()) continue;
        SCOPED_TRACE(name);
        const StrandSet set = importStrands(corpus(name));
        EXPECT_EQ(set.strandCount(), strands);
        EXPECT_EQ(brokenPromise(set), "");
    }
    EXPECT_THAT(filesIn(corpus("")), testing::UnorderedElementsAreArray(expected));
}

TEST(Corpus, FindingsAreErrorsOrSets) {
    for (const std::string& name : filesIn(corpus("findings"))) {
        SCOPED_TRACE(name);
        try {
            EXPECT_EQ(brokenPromise(importStrands(corpus("findings/" + name))), "");
        } catch (const engine::Error&) {
        }
    }
}

}  // namespace
}  // namespace hair::groom
