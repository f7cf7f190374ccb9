#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "tests/temporary_folder.h"

// Writes binary glTF files with skins, morph targets and animations. Makes their text and bytes by
// hand.
class AnimatedGltf {
public:
    // Add an accessor and return its index.
    int scalars(const std::vector<float>& values) { return accessor(values, 5126, "SCALAR"); }
    int vectors(const std::vector<glm::vec3>& values) { return accessor(values, 5126, "VEC3"); }
    int rotations(const std::vector<glm::vec4>& values) { return accessor(values, 5126, "VEC4"); }
    int joints(const std::vector<glm::u8vec4>& values) { return accessor(values, 5121, "VEC4"); }
    int indices(const std::vector<std::uint32_t>& values) {
        return accessor(values, 5125, "SCALAR");
    }
    int matrices(const std::vector<std::array<float, 16>>& values) {
        return accessor(values, 5126, "MAT4");
    }
    // Adds an accessor of `count` zeros except for the elements at `places`.
    int sparseVectors(
        std::size_t count, const std::vector<std::uint16_t>& places,
        const std::vector<glm::vec3>& values) {
        const int first = view(places);
        const int second = view(values);
        accessors_ += separator(accessors_) + R"({"componentType":5126,"type":"VEC3","count":)" +
                      std::to_string(count) + R"(,"sparse":{"count":)" +
                      std::to_string(places.size()) + R"(,"indices":{"bufferView":)" +
                      std::to_string(first) + R"(,"componentType":5123},"values":{"bufferView":)" +
                      std::to_string(second) + "}}}";
        return count_++;
    }

    // Parts of the document, without the brackets around them.
    std::string nodes;  // "nodes"; the scene has the first
    std::string primitive;  // the only primitive of the only mesh
    std::string mesh;  // further members of the mesh, after a comma
    std::string skin;  // the only skin; empty: none
    std::string animations;  // "animations"

    std::filesystem::path write(const TemporaryFolder& folder) const {
        std::string json =
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
            R"(],"meshes":[{"primitives":[{)" + primitive + "}]" + mesh + "}]" +
            (skin.empty() ? "" : R"(,"skins":[{)" + skin + "}]") +
            (animations.empty() ? "" : R"(,"animations":[)" + animations + "]") +
            R"(,"accessors":[)" + accessors_ + R"(],"bufferViews":[)" + views_ +
            R"(],"buffers":[{"byteLength":)" + std::to_string(data_.size()) + "}]}";
        while (json.size() % 4 != 0) json += ' ';
        std::string bytes = "glTF";
        put(bytes, 2);
        put(bytes, 28 + json.size() + data_.size());
        put(bytes, json.size());
        bytes += "JSON" + json;
        put(bytes, data_.size());
        return folder.write("animated.glb", bytes + std::string("BIN\0", 4) + data_);
    }

private:
    static std::string separator(const std::string& list) { return list.empty() ? "" : ","; }

    static void put(std::string& bytes, std::size_t word) {
        const auto value = static_cast<std::uint32_t>(word);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }

    template <class Value>
    int view(const std::vector<Value>& values) {
        const std::size_t bytes = values.size() * sizeof(Value);
        views_ += separator(views_) + R"({"buffer":0,"byteOffset":)" +
                  std::to_string(data_.size()) + R"(,"byteLength":)" + std::to_string(bytes) + "}";
        data_.append(reinterpret_cast<const char*>(values.data()), bytes);
        while (data_.size() % 4 != 0) data_ += '\0';
        return views_count_++;
    }

    template <class Value>
    int accessor(const std::vector<Value>& values, int component, const std::string& type) {
        const int number = view(values);
        accessors_ += separator(accessors_) + R"({"bufferView":)" + std::to_string(number) +
                      R"(,"componentType":)" + std::to_string(component) + R"(,"type":")" + type +
                      R"(","count":)" + std::to_string(values.size()) + "}";
        return count_++;
    }

    std::string data_;
    std::string views_;
    std::string accessors_;
    int views_count_ = 0;
    int count_ = 0;
};
