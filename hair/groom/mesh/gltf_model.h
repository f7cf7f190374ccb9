#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

// tinygltf's classes differ with these.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

namespace hair {

// What of a file's images there is.
enum class GltfImages {
    skipped,
    named,  // name, bufferView and uri, data in it included, as the file says; textures and
            // samplers
};

// glTF 2.0, .gltf or, by its first bytes, .glb. Buffers in files of their own are read from the
// folder of `path`, or refused where that is empty. What nobody here needs is left out. Refuses
// extensions that the file requires and that change the geometry. Throws engine::Error without
// naming the file.
tinygltf::Model loadGltf(
    std::span<const std::byte> bytes, const std::filesystem::path& path,
    GltfImages images = GltfImages::skipped);

}  // namespace hair
