#include <gmock/gmock.h>

#include "engine/pictures.h"
#include "hair/groom/mesh/import_mesh.h"
#include "tests/error_text.h"
#include "tests/temporary_folder.h"

namespace hair::groom {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// A PNG of 2 by 1 pixels, (255, 0, 0) and (0, 128, 255) and opacities 255 and 64, in base 64; made
// with Python's zlib by the PNG specification.
constexpr std::string_view kPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEUlEQVR42mP4z8Dwn6HhvwMAELoDvjp5v74AAAAASU"
    "VORK5CYII=";

// A triangle, and a material that tests write.
struct Document {
    std::string material = "";
    std::string textures = R"([{"source":0}])";
    std::string images =
        R"([{"name":"paint","uri":"data:image/png;base64,)" + std::string(kPng) + R"("}])";
    std::string extra = "";
};

std::string gltf(const Document& document) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
           R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
           R"("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AAAAQAAAAAAAAAAA"}],)"
           R"("materials":[{)" +
           document.material + R"(}],"textures":)" + document.textures + R"(,"images":)" +
           document.images + document.extra + "}";
}

constexpr const char* kPainted = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";

class GltfMaterials : public testing::Test {
protected:
    Mesh import(const Document& document, Textures textures = Textures::decoded) const {
        return importMesh(folder_.write("a.gltf", gltf(document)), textures);
    }

    Material material(const Document& document) const { return import(document).materials.at(1); }

    std::string error(const Document& document) const {
        return folder_.relative(errorText([&] { import(document); }));
    }

    TemporaryFolder folder_;
};

TEST_F(GltfMaterials, HaveTheirFactors) {
    const Material read = material(
        {.material = R"("name":"paint","doubleSided":true,"pbrMetallicRoughness":{)"
                     R"("metallicFactor":0.25,"roughnessFactor":0.75,)"
                     R"("baseColorFactor":[1,0,1,0.5]})"});
    EXPECT_EQ(read.name, "paint");
    EXPECT_EQ(read.base_color, glm::vec3(1, 0, 1));
    EXPECT_EQ(read.opacity, 0.5f);
    EXPECT_EQ(read.metallic, 0.25f);
    EXPECT_EQ(read.roughness, 0.75f);
    EXPECT_TRUE(read.double_sided);
    EXPECT_FALSE(read.cutoff);
}

// glTF 2.0, section 3.9: the defaults of a material.
TEST_F(GltfMaterials, HaveTheSpecificationsDefaults) {
    const Material read = material({});
    EXPECT_EQ(read.base_color, glm::vec3(1));
    EXPECT_EQ(read.metallic, 1.0f);
    EXPECT_EQ(read.roughness, 1.0f);
    EXPECT_EQ(read.normal_scale, 1.0f);
    EXPECT_FALSE(read.double_sided);
    EXPECT_FALSE(read.base_color_texture || read.normal_texture || read.metallic_roughness_texture);
}

TEST_F(GltfMaterials, CutByTheirAlphaMode) {
    EXPECT_EQ(material({.material = R"("alphaMode":"MASK")"}).cutoff, 0.5f);
    EXPECT_EQ(material({.material = R"("alphaMode":"MASK","alphaCutoff":0.25)"}).cutoff, 0.25f);
    EXPECT_EQ(material({.material = R"("alphaMode":"BLEND","alphaCutoff":0.25)"}).cutoff, 0.5f);
}

TEST_F(GltfMaterials, HaveTheirTextures) {
    const Mesh mesh = import(
        {.material = R"("normalTexture":{"index":1,"scale":0.5},"pbrMetallicRoughness":{)"
                     R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":2}})",
         .textures = R"([{"source":0},{"source":0,"sampler":0},{"source":0,"sampler":1}])",
         .extra = R"(,"samplers":[{"wrapS":33071,"wrapT":33648,"magFilter":9728},{}])"});
    const Material& read = mesh.materials.at(1);
    ASSERT_TRUE(read.base_color_texture && read.normal_texture && read.metallic_roughness_texture);
    EXPECT_EQ(read.normal_scale, 0.5f);
    EXPECT_EQ(read.base_color_texture->horizontal, Wrap::repeat);
    EXPECT_TRUE(read.base_color_texture->is_smooth);
    EXPECT_EQ(read.normal_texture->horizontal, Wrap::clamp);
    EXPECT_EQ(read.normal_texture->vertical, Wrap::mirror);
    EXPECT_FALSE(read.normal_texture->is_smooth);
    EXPECT_EQ(read.metallic_roughness_texture->vertical, Wrap::repeat);
    ASSERT_EQ(mesh.pictures.size(), 1u);  // all materials share it
    EXPECT_EQ(mesh.pictures[0].width, 2u);
    EXPECT_EQ(mesh.pictures[0].height, 1u);
    EXPECT_THAT(mesh.pictures[0].rgba, ElementsAre(255, 0, 0, 255, 0, 128, 255, 64));
}

TEST_F(GltfMaterials, LeaveTexturesThatNobodyWants) {
    const Mesh mesh =
        import({.material = kPainted, .images = R"([{"uri":"nowhere.png"}])"}, Textures::skipped);
    EXPECT_FALSE(mesh.materials.at(1).base_color_texture);
    EXPECT_TRUE(mesh.pictures.empty());
}

TEST_F(GltfMaterials, FindPicturesBesideTheFile) {
    const std::vector<std::uint8_t> rgba{1, 2, 3, 4};
    engine::writePng(folder_.file("a picture.png"), 1, 1, rgba);
    const Mesh mesh = import({.material = kPainted, .images = R"([{"uri":"a%20picture.png"}])"});
    EXPECT_EQ(mesh.pictures.at(0).rgba, rgba);
}

// The 36 bytes of the positions are not a picture, and the file contains no others.
TEST_F(GltfMaterials, FindPicturesInBuffers) {
    EXPECT_EQ(
        error({.material = kPainted, .images = R"([{"name":"skin","bufferView":0}])"}),
        "a.gltf: material 0: baseColorTexture: image 0 'skin': is not a PNG, JPEG, TGA or BMP");
    EXPECT_EQ(
        error({.material = kPainted, .images = R"([{"bufferView":1}])"}),
        "a.gltf: material 0: baseColorTexture: image 0: the file names buffer view 1, but it has "
        "1");
}

TEST_F(GltfMaterials, NameWhatIsWrongWithAPicture) {
    const auto image_error = [&](const char* images) {
        return error({.material = kPainted, .images = images});
    };
    EXPECT_THAT(
        image_error(R"([{"name":"skin","uri":"nowhere.png"}])"),
        AllOf(
            StartsWith("a.gltf: material 0: baseColorTexture: image 0 'skin': "),
            HasSubstr("nowhere.png: no such file")));
    EXPECT_THAT(image_error(R"([{"uri":"data:image/png;base64,iVBO#"}])"), HasSubstr("damaged"));
    EXPECT_THAT(image_error(R"([{"uri":"data:image/png,iVBO"}])"), HasSubstr("base 64"));
    EXPECT_THAT(image_error(R"([{"uri":"data:image/png;base64,iVBO"}])"), HasSubstr("not a PNG"));
    EXPECT_THAT(image_error(R"([{}])"), HasSubstr("neither a bufferView nor a uri"));
    EXPECT_THAT(image_error(R"([])"), HasSubstr("names image 0, but it has 0"));
    EXPECT_THAT(image_error(R"([7])"), HasSubstr("image 0: is not an object"));
    EXPECT_THAT(image_error(R"({"a":1})"), HasSubstr("'images' is not an array"));
    EXPECT_THAT(image_error(R"([{"uri":7}])"), HasSubstr("type"));
}

TEST_F(GltfMaterials, RefuseOtherTextureCoordinates) {
    EXPECT_THAT(
        error({.material = R"("normalTexture":{"index":0,"texCoord":1})"}),
        HasSubstr("material 0: normalTexture: TEXCOORD_1 is not supported"));
    EXPECT_THAT(
        error(
            {.material = R"("normalTexture":{"index":0,"extensions":)"
                         R"({"KHR_texture_transform":{"scale":[2,2]}}})"}),
        HasSubstr("KHR_texture_transform is not supported"));
    EXPECT_THAT(
        error({.material = R"("normalTexture":{"index":3})"}), HasSubstr("names texture 3"));
}

TEST_F(GltfMaterials, RefuseFactorsThatAreNone) {
    EXPECT_THAT(
        error({.material = R"("pbrMetallicRoughness":{"metallicFactor":1.5})"}),
        HasSubstr("material 0: metallicFactor: is outside [0, 1]"));
}

TEST(ObjMaterials, HaveTheDiffusePicture) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> rgba{9, 8, 7, 255};
    engine::writePng(folder.file("paint.png"), 1, 1, rgba);
    folder.write("a.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n");
    const auto path = folder.write(
        "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl paint\n"
                 "f 1/1 2/2 3/3\n");
    const Mesh mesh = importMesh(path, Textures::decoded);
    const Material& paint = mesh.materials.at(mesh.triangle_materials.at(0));
    ASSERT_TRUE(paint.base_color_texture);
    EXPECT_EQ(mesh.pictures.at(paint.base_color_texture->picture).rgba, rgba);
    EXPECT_TRUE(importMesh(path).pictures.empty());
}

}  // namespace
}  // namespace hair::groom
