// The only unit that has tinygltf's functions and sees nlohmann's JSON: assimp's libdraco exports a
// tinygltf of its own, so this one is compiled in here, with hidden visibility.
#include <nlohmann/json.hpp>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include "hair/groom/mesh/gltf_model.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/error.h"
#include "hair/groom/mesh/base64.h"
#include "hair/groom/mesh/glb_file.h"

namespace hair {
namespace {

using json = nlohmann::json;

// tinygltf takes its recursion from the file; no glTF file is half as deep.
constexpr int kMaximumDepth = 64;
// tinygltf counts base 64 in int.
constexpr std::size_t kMaximumJson = std::numeric_limits<std::int32_t>::max();

// RFC 2397; the second is of glTF 2.0, section 3.6.1.1.
constexpr std::array<std::string_view, 2> kDataTypes{
    "data:application/octet-stream;base64,", "data:application/gltf-buffer;base64,"};

constexpr std::array<std::string_view, 11> kSections{
    "asset",
    "scene",
    "scenes",
    "nodes",
    "meshes",
    "accessors",
    "bufferViews",
    "buffers",
    "materials",
    "extensionsUsed",
    "extensionsRequired"};
constexpr std::array<std::string_view, 3> kImageSections{"images", "textures", "samplers"};

[[noreturn]] void fail(std::size_t byte, const std::string& reason) {
    throw engine::Error("byte " + std::to_string(byte), reason);
}

// The first line of what tinygltf or nlohmann says, which may go on with all the file's data.
std::string firstLine(std::string_view text) {
    constexpr std::size_t kLongest = 200;
    const std::string_view line = text.substr(0, std::min(text.find('\n'), kLongest));
    return line.empty() ? "not a glTF file" : std::string(line);
}

// The data of the first buffer, where it is in the JSON, as .glb files have it: tinygltf takes half
// a minute for half a gigabyte of base 64. Empty where there is none.
std::string takeData(json& document) {
    const auto buffers = document.find("buffers");
    if (buffers == document.end() || !buffers->is_array() || buffers->empty()) return {};
    json& buffer = buffers->front();
    const auto uri = buffer.find("uri");
    if (uri == buffer.end() || !uri->is_string()) return {};
    const std::string_view text = uri->get_ref<const std::string&>();
    for (const std::string_view type : kDataTypes) {
        if (!text.starts_with(type)) continue;
        std::optional<std::string> data = decodeBase64(text.substr(type.size()));
        if (!data) return {};
        buffer.erase(uri);
        return *std::move(data);
    }
    return {};
}

// The images without what is in them, taken from the document: tinygltf would look for their bytes
// outside of buffers.
std::vector<tinygltf::Image> takeImages(json& document) {
    std::vector<tinygltf::Image> images;
    const auto section = document.find("images");
    if (section == document.end()) return images;
    if (!section->is_array()) throw engine::Error("'images' is not an array");
    for (const json& image : *section) {
        if (!image.is_object())
            throw engine::Error("image " + std::to_string(images.size()), "is not an object");
        tinygltf::Image& added = images.emplace_back();
        added.name = image.value("name", "");
        added.uri = image.value("uri", "");
        added.bufferView = image.value("bufferView", -1);
    }
    document.erase(section);
    return images;
}

bool isRead(const std::string& section, GltfImages images) {
    if (std::ranges::find(kSections, section) != kSections.end()) return true;
    return images == GltfImages::named &&
           std::ranges::find(kImageSections, section) != kImageSections.end();
}

struct Rewritten {
    std::optional<std::string> file;  // absent where it is the file that was given
    std::vector<tinygltf::Image> images;
};

// The file as tinygltf is to read it: without images and the sections that aren't read, and with
// the first buffer's data in a chunk.
Rewritten rewritten(std::string_view file, GltfImages images) {
    const GlbChunks chunks = isGlb(file) ? glbChunks(file) : GlbChunks{file, {}};
    const auto offset = static_cast<std::size_t>(chunks.json.data() - file.data());
    if (chunks.json.size() > kMaximumJson) fail(offset, "JSON of 2^31 bytes or more");
    bool has_others = false;
    const auto keep = [&](int depth, json::parse_event_t event, json& parsed) {
        if (depth > kMaximumDepth) {
            throw engine::Error(
                "the JSON has more than " + std::to_string(kMaximumDepth) + " levels");
        }
        if (depth != 1 || event != json::parse_event_t::key) return true;
        const auto& key = parsed.get_ref<const std::string&>();
        if (isRead(key, images)) return true;
        has_others = true;
        return false;
    };
    try {
        json document = json::parse(chunks.json.begin(), chunks.json.end(), keep);
        const std::string data = isGlb(file) ? std::string() : takeData(document);
        std::vector<tinygltf::Image> taken = takeImages(document);
        if (data.empty() && !has_others && taken.empty()) return {};
        std::string text = document.dump();
        if (!data.empty() || isGlb(file))
            text = glbFile({text, data.empty() ? chunks.binary : data});
        return {std::move(text), std::move(taken)};
    } catch (const json::parse_error& error) {
        const std::string message = firstLine(error.what());
        fail(
            offset + std::max<std::size_t>(error.byte, 1) - 1,
            "not JSON" + message.substr(message.find(": ")));
    } catch (const json::exception& error) {  // such as a number that no double holds
        fail(offset, firstLine(error.what()));
    }
}

// Later versions of tinygltf have one callback more.
template <class Callbacks>
Callbacks noOtherFiles() {
    Callbacks callbacks{};
    callbacks.FileExists = [](const std::string&, void*) { return false; };
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>*, std::string*, const std::string&,
                                 void*) { return false; };
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t*, std::string*, const std::string&, void*) {
            return false;
        };
    }
    return callbacks;
}

void checkExtensions(const tinygltf::Model& model) {
    for (const std::string& extension : model.extensionsRequired) {
        if (extension.starts_with("KHR_materials_") || extension == "KHR_texture_transform")
            continue;
        throw engine::Error("the file needs " + extension + ", which is not supported");
    }
}

}  // namespace

tinygltf::Model
loadGltf(std::span<const std::byte> bytes, const std::filesystem::path& path, GltfImages images) {
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (file.size() > std::numeric_limits<std::uint32_t>::max()) fail(0, "4 GiB or more");
    Rewritten other = rewritten(file, images);
    const std::string_view text = other.file ? std::string_view(*other.file) : file;

    tinygltf::TinyGLTF loader;
    if (path.empty()) loader.SetFsCallbacks(noOtherFiles<tinygltf::FsCallbacks>());
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const auto size = static_cast<unsigned>(text.size());
    const std::string folder = path.parent_path().string();
    try {
        const bool loaded =
            isGlb(text)
                ? loader.LoadBinaryFromMemory(
                      &model, &error, &warning, reinterpret_cast<const unsigned char*>(text.data()),
                      size, folder)
                : loader.LoadASCIIFromString(&model, &error, &warning, text.data(), size, folder);
        // It goes on after some errors, without what they are in.
        if (!loaded || !error.empty()) throw engine::Error(firstLine(error));
    } catch (const engine::Error&) {
        throw;
    } catch (const std::exception& exception) {
        throw engine::Error(firstLine(exception.what()));
    }
    checkExtensions(model);
    model.images = std::move(other.images);
    return model;
}

}  // namespace hair
