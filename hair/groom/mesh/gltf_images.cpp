#include "hair/groom/mesh/gltf_images.h"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "engine/error.h"
#include "hair/groom/mesh/base64.h"
#include "hair/groom/mesh/gltf_accessors.h"

namespace hair {
namespace {

std::string_view bytesOfView(const tinygltf::Model& model, int index) {
    const tinygltf::BufferView& view = at(model.bufferViews, index, "buffer view");
    const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
    const std::size_t available = buffer.data.size();
    if (view.byteOffset > available || view.byteLength > available - view.byteOffset)
        throw engine::Error(numbered("buffer view", index), "lies outside its buffer");
    return {reinterpret_cast<const char*>(buffer.data.data()) + view.byteOffset, view.byteLength};
}

// RFC 2397, in base 64: what is behind the comma.
std::string bytesOfDataUri(std::string_view uri) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    if (mark == std::string_view::npos) throw engine::Error("its data are not in base 64");
    std::optional<std::string> bytes = decodeBase64(uri.substr(mark + kMark.size()));
    if (!bytes) throw engine::Error("its base 64 is damaged");
    return *std::move(bytes);
}

// RFC 3986, section 2.1: "%20" is a space.
std::string decodePercents(std::string_view uri) {
    std::string decoded;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* digits = uri.data() + i + 1;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
            decoded += static_cast<char>(byte);
            i += 2;
        } else {
            decoded += uri[i];
        }
    }
    return decoded;
}

}  // namespace

engine::Pixels
decodeGltfImage(const tinygltf::Model& model, int index, const std::filesystem::path& folder) {
    const tinygltf::Image& image = at(model.images, index, "image");
    const std::string name = image.name.empty() ? "" : " '" + image.name + "'";
    try {
        if (image.bufferView >= 0) return engine::decodeImage(bytesOfView(model, image.bufferView));
        if (image.uri.empty()) throw engine::Error("has neither a bufferView nor a uri");
        if (image.uri.starts_with("data:")) return engine::decodeImage(bytesOfDataUri(image.uri));
        return engine::readImage(folder / decodePercents(image.uri));
    } catch (const engine::Error& error) {
        throw engine::Error(numbered("image", index) + name, error.what());
    }
}

}  // namespace hair
