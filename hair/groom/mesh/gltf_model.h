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

// glTF 2.0, .gltf or, by its first bytes, .glb. Buffers in files of their own are read from the
// folder of `path`, or refused where that is empty. What meshes and lines don't need, images first
// of all, is left out. Refuses extensions that the file requires and that change the geometry.
// Throws engine::Error without naming the file.
tinygltf::Model loadGltf(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace hair
