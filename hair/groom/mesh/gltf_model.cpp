// The only unit that contains tinygltf's functions and sees nlohmann's JSON. assimp's libdraco
// exports a tinygltf of its own, so this one is compiled in here, with hidden visibility.
#include <nlohmann/json.hpp>
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_INCLUDE_JSON
#include "hair/groom/mesh/gltf_model.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "engine/error.h"
#include "engine/files.h"
#include "hair/groom/formats/binary_file.h"

namespace hair::groom {
namespace {

// ---- Base64 -------------------------------------------------------------------------------------

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t kWrong = 64;

constexpr std::array<std::uint8_t, 256> kValues = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(kWrong);
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

}  // namespace

std::optional<std::string> decodeBase64(std::string_view text) {
    if (text.size() % 4 != 0) return {};
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    std::string bytes(text.size() / 4 * 3, '\0');
    std::uint32_t seen = 0;
    for (std::size_t group = 0; group < text.size() / 4; ++group) {
        const bool is_last = 4 * (group + 1) == text.size();
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const bool is_padding = is_last && i >= 4 - padding;
            const auto c = static_cast<unsigned char>(text[4 * group + i]);
            const std::uint32_t value = is_padding ? 0 : kValues[c];
            seen |= value;
            bits = bits << 6 | value;
        }
        for (std::size_t i = 0; i < 3; ++i)
            bytes[3 * group + i] = static_cast<char>(bits >> (16 - 8 * i) & 0xff);
    }
    if (seen >= kWrong) return {};
    bytes.resize(bytes.size() - padding);
    return bytes;
}

namespace {

// ---- Glb file -----------------------------------------------------------------------------------

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeaderSize = 12;  // magic, version, length
constexpr std::size_t kChunkHeaderSize = 8;  // length, type
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

[[noreturn]] void fail(std::size_t byte, const std::string& reason) {
    throw engine::Error("byte " + std::to_string(byte), reason);
}

std::uint32_t wordAt(std::string_view file, std::size_t offset) {
    std::array<unsigned char, 4> b{};
    std::memcpy(b.data(), file.data() + offset, b.size());
    return b[0] | (std::uint32_t{b[1]} << 8) | (std::uint32_t{b[2]} << 16) |
           (std::uint32_t{b[3]} << 24);
}

void appendWord(std::string& file, std::size_t word) {
    for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(word >> shift & 0xff);
}

// The data of a chunk.
std::string_view chunkAt(std::string_view file, std::size_t offset, std::uint32_t type) {
    if (file.size() - offset < kChunkHeaderSize) {
        fail(file.size(), "truncated: a chunk's header is expected");
    }
    const std::size_t size = wordAt(file, offset);
    if (wordAt(file, offset + 4) != type) {
        fail(offset + 4, std::string("the chunk isn't ") + (type == kJsonChunk ? "JSON" : "BIN"));
    }
    if (size > file.size() - offset - kChunkHeaderSize) {
        fail(
            offset, "truncated: the chunk has " + std::to_string(size) + " bytes, but only " +
                        std::to_string(file.size() - offset - kChunkHeaderSize) + " are there");
    }
    return file.substr(offset + kChunkHeaderSize, size);
}

void appendChunk(std::string& file, std::uint32_t type, std::string_view data, char padding) {
    const std::size_t padded = (data.size() + 3) / 4 * 4;
    appendWord(file, padded);
    appendWord(file, type);
    file.append(data).append(padded - data.size(), padding);
}

// Returns a file of these chunks.
std::string glbFile(const GlbChunks& chunks) {
    std::string data;
    data.reserve(chunks.json.size() + chunks.binary.size() + 64);
    data.append(kMagic);
    appendWord(data, 2);
    appendWord(data, 0);
    appendChunk(data, kJsonChunk, chunks.json, ' ');
    if (!chunks.binary.empty()) appendChunk(data, kBinaryChunk, chunks.binary, '\0');
    std::string length;
    appendWord(length, data.size());
    return data.replace(8, 4, length);
}

}  // namespace

bool isGlb(std::string_view file) { return file.starts_with(kMagic); }

// Checked here, because tinygltf looks for the end of the second chunk 8 bytes too late.
GlbChunks glbChunks(std::string_view file) {
    if (file.size() < kHeaderSize) fail(file.size(), "truncated: the header alone is 12 bytes");
    const std::uint32_t version = wordAt(file, 4);
    const std::uint32_t length = wordAt(file, 8);
    if (version != 2) fail(4, "version " + std::to_string(version) + " of glTF, expected 2");
    if (length != file.size()) {
        fail(
            8, "the header says that there are " + std::to_string(length) +
                   " bytes, but there are " + std::to_string(file.size()));
    }
    const std::string_view json = chunkAt(file, kHeaderSize, kJsonChunk);
    const std::size_t end = kHeaderSize + kChunkHeaderSize + json.size();
    if (end == file.size()) return {json, {}};
    return {json, chunkAt(file, end, kBinaryChunk)};
}

namespace {

// ---- Gltf model ---------------------------------------------------------------------------------

using json = nlohmann::json;

// tinygltf recurses as deep as the file nests. No real glTF file is half as deep.
constexpr int kMaximumDepth = 64;
// tinygltf counts base 64 in int.
constexpr std::size_t kMaximumJson = std::numeric_limits<std::int32_t>::max();

// The first is from RFC 2397, the second from glTF 2.0, section 3.6.1.1.
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
constexpr std::array<std::string_view, 2> kMotionSections{"skins", "animations"};

// The first line of an error of tinygltf or nlohmann, which may go on with all the file's data.
std::string firstLine(std::string_view text) {
    constexpr std::size_t kLongest = 200;
    const std::string_view line = text.substr(0, std::min(text.find('\n'), kLongest));
    return line.empty() ? "is not a glTF file" : std::string(line);
}

// "[json.exception.out_of_range.406] reason" -> "reason"
std::string reasonIn(std::string_view text) {
    if (const std::size_t end = text.find("] "); text.starts_with("[json") && end != text.npos)
        text.remove_prefix(end + 2);
    return firstLine(text);
}

// Takes the data of the first buffer out of the JSON, for a binary chunk as in .glb files: tinygltf
// takes half a minute for half a gigabyte of base 64. Empty if there is none in the JSON.
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

// Takes the images out of the document, without their contents, because tinygltf would look for
// their bytes outside buffers.
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

// Names missing inverse bind matrices, because tinygltf requires them. glTF lets skins leave them
// out if they are the identity. Returns whether any were missing.
bool nameMissingMatrices(json& document) {
    const auto skins = document.find("skins");
    if (skins == document.end() || !skins->is_array()) return false;
    bool found = false;
    for (json& skin : *skins) {
        if (!skin.is_object() || skin.contains("inverseBindMatrices")) continue;
        skin["inverseBindMatrices"] = -1;
        found = true;
    }
    return found;
}

bool isRead(const std::string& section, GltfImages images, GltfMotion motion) {
    const auto isOf = [&](std::span<const std::string_view> sections) {
        return std::ranges::find(sections, section) != sections.end();
    };
    return isOf(kSections) || (images == GltfImages::named && isOf(kImageSections)) ||
           (motion == GltfMotion::read && isOf(kMotionSections));
}

// Removes the sections that aren't read from the document. Returns whether there were any.
bool dropOthers(json& document, GltfImages images, GltfMotion motion) {
    if (!document.is_object()) return false;
    bool found = false;
    for (auto section = document.begin(); section != document.end();) {
        const bool is_read = isRead(section.key(), images, motion);
        section = is_read ? std::next(section) : document.erase(section);
        found |= !is_read;
    }
    return found;
}

// The greatest number of open brackets.
int depthOf(std::string_view text) {
    int depth = 0;
    int most = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') {
            for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
        } else if (text[i] == '{' || text[i] == '[') {
            most = std::max(most, ++depth);
        } else if (text[i] == '}' || text[i] == ']') {
            --depth;
        }
    }
    return most;
}

constexpr std::string_view kQuantization = "KHR_mesh_quantization";
constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
// The second has more filters and a later version of the same streams.
constexpr std::array<std::string_view, 2> kMeshopt{
    "EXT_meshopt_compression", "KHR_meshopt_compression"};

// Refuses required extensions that are not known.
void checkExtensions(const json& document) {
    const auto required =
        document.is_object() ? document.find("extensionsRequired") : document.end();
    if (required == document.end() || !required->is_array()) return;
    for (const json& element : *required) {
        if (!element.is_string()) continue;
        const auto& extension = element.get_ref<const std::string&>();
        if (extension.starts_with("KHR_materials_") || extension == "KHR_texture_transform" ||
            extension == kQuantization || extension == kDraco ||
            std::ranges::find(kMeshopt, extension) != kMeshopt.end())
            continue;
        throw engine::Error("the file needs " + extension + ", which is not supported");
    }
}

// ---- Compressed parts ---------------------------------------------------------------------------

// Return the element or member, or null if there is none of this name or the value can't have any.
json* memberOf(json& object, std::string_view name) {
    if (!object.is_object()) return nullptr;
    const auto member = object.find(name);
    return member == object.end() ? nullptr : &*member;
}

json* elementOf(json* array, std::int64_t index) {
    if (!array || !array->is_array() || index < 0 ||
        static_cast<std::size_t>(index) >= array->size())
        return nullptr;
    return &(*array)[static_cast<std::size_t>(index)];
}

json* extensionOf(json& object, std::string_view name) {
    json* const extensions = memberOf(object, "extensions");
    json* const extension = extensions ? memberOf(*extensions, name) : nullptr;
    return extension && extension->is_object() ? extension : nullptr;
}

json* meshoptOf(json& object) {
    for (const std::string_view name : kMeshopt)
        if (json* const extension = extensionOf(object, name)) return extension;
    return nullptr;
}

// Gives buffers that only stand for bytes after decompression a byte of data, because tinygltf
// requires a source of each buffer. Returns which buffers these are.
std::vector<bool> fillFallbacks(json& document, bool has_chunk) {
    std::vector<bool> filled;
    json* const buffers = memberOf(document, "buffers");
    if (!buffers || !buffers->is_array()) return filled;
    for (json& buffer : *buffers) {
        const bool is_chunk = has_chunk && filled.empty();
        filled.push_back(!is_chunk && meshoptOf(buffer) && !memberOf(buffer, "uri"));
        if (!filled.back()) continue;
        buffer["uri"] = std::string(kDataTypes.front()) + "AA==";
        buffer["byteLength"] = 1;
    }
    return filled;
}

// Returns the buffer views that have no data but compressed ones.
std::vector<GltfCompression::View>
compressedViews(json& document, const std::vector<bool>& fallbacks) {
    std::vector<GltfCompression::View> compressed;
    json* const views = memberOf(document, "bufferViews");
    if (!views || !views->is_array()) return compressed;
    for (std::size_t i = 0; i < views->size(); ++i) {
        json& view = (*views)[i];
        const json* const extension = meshoptOf(view);
        if (!extension) continue;
        const auto buffer = view.value("buffer", std::size_t{0});
        if (buffer < fallbacks.size() && !fallbacks[buffer]) continue;
        compressed.push_back(
            {.view = static_cast<int>(i),
             .buffer = extension->value("buffer", -1),
             .offset = extension->value("byteOffset", std::uint64_t{0}),
             .length = extension->value("byteLength", std::uint64_t{0}),
             .stride = extension->value("byteStride", std::uint64_t{0}),
             .count = extension->value("count", std::uint64_t{0}),
             .mode = extension->value("mode", std::string()),
             .filter = extension->value("filter", std::string("NONE"))});
    }
    return compressed;
}

// Returns the primitives that have data only in Draco's form. Their accessors get the view of the
// compressed data, because tinygltf requires views of indices.
std::vector<GltfCompression::Primitive> compressedPrimitives(json& document) {
    std::vector<GltfCompression::Primitive> compressed;
    json* const meshes = memberOf(document, "meshes");
    json* const accessors = memberOf(document, "accessors");
    if (!meshes || !meshes->is_array()) return compressed;
    for (std::size_t mesh = 0; mesh < meshes->size(); ++mesh) {
        json* const primitives = memberOf((*meshes)[mesh], "primitives");
        if (!primitives || !primitives->is_array()) continue;
        for (std::size_t i = 0; i < primitives->size(); ++i) {
            json& primitive = (*primitives)[i];
            const json* const extension = extensionOf(primitive, kDraco);
            if (!extension) continue;
            GltfCompression::Primitive read{
                .mesh = static_cast<int>(mesh),
                .primitive = static_cast<int>(i),
                .view = extension->value("bufferView", -1),
                .attributes = extension->value("attributes", decltype(read.attributes)())};
            json* const attributes = memberOf(primitive, "attributes");
            std::vector<json*> parts{elementOf(accessors, primitive.value("indices", -1))};
            for (const auto& [name, id] : read.attributes)
                if (json* const index = attributes ? memberOf(*attributes, name) : nullptr)
                    parts.push_back(elementOf(accessors, index->get<std::int64_t>()));
            bool has_data = true;
            for (json* const part : parts) {
                if (!part || memberOf(*part, "bufferView")) continue;
                if (!part->is_object()) continue;
                has_data = false;
                (*part)["bufferView"] = read.view;
            }
            if (!has_data) compressed.push_back(std::move(read));
        }
    }
    return compressed;
}

struct Rewritten {
    std::optional<std::string> file;  // absent if the given file stays as it is
    std::vector<tinygltf::Image> images;
    GltfCompression compression;
};

// The file as tinygltf is to read it: without images and the sections that aren't read, and with
// the first buffer's data in a chunk.
Rewritten rewritten(std::string_view file, GltfImages images, GltfMotion motion) {
    const GlbChunks chunks = isGlb(file) ? glbChunks(file) : GlbChunks{file, {}};
    const auto offset = static_cast<std::size_t>(chunks.json.data() - file.data());
    if (chunks.json.size() > kMaximumJson) fail(offset, "JSON of 2^31 bytes or more");
    if (depthOf(chunks.json) > kMaximumDepth)
        throw engine::Error("the JSON has more than " + std::to_string(kMaximumDepth) + " levels");
    try {
        // Does not use nlohmann's callback, which takes quadratic time in the length of an array.
        json document = json::parse(chunks.json.begin(), chunks.json.end());
        checkExtensions(document);
        bool has_others = dropOthers(document, images, motion);
        const std::string data = isGlb(file) ? std::string() : takeData(document);
        std::vector<tinygltf::Image> taken = takeImages(document);
        has_others |= nameMissingMatrices(document);
        const std::vector<bool> fallbacks = fillFallbacks(document, isGlb(file) || !data.empty());
        GltfCompression compression{
            .views = compressedViews(document, fallbacks),
            .primitives = compressedPrimitives(document)};
        has_others |= !compression.views.empty() || !compression.primitives.empty();
        if (data.empty() && !has_others && taken.empty()) return {};
        std::string text = document.dump();
        if (!data.empty() || isGlb(file))
            text = glbFile({text, data.empty() ? chunks.binary : data});
        return {std::move(text), std::move(taken), std::move(compression)};
    } catch (const json::parse_error& error) {
        const std::string message = firstLine(error.what());
        fail(
            offset + std::max<std::size_t>(error.byte, 1) - 1,
            "is not JSON" + message.substr(message.find(": ")));
    } catch (const json::exception& error) {  // such as a number that no double holds
        fail(offset, "can't be read as JSON: " + reasonIn(error.what()));
    }
}

// The files of buffers. tinygltf opens files only by these functions; their `user_data` is a
// FileAccess.
struct FileAccess {
    bool allowed = false;
    const NamedFileCheck& check;
};

bool isBufferFile(const std::string& path, void* user_data) {
    const auto& access = *static_cast<const FileAccess*>(user_data);
    std::error_code error;
    if (!access.allowed || !std::filesystem::exists(path, error)) return false;
    if (access.check) access.check(path);
    return true;
}

bool readBufferFile(
    std::vector<unsigned char>* bytes, std::string*, const std::string& path, void* user_data) {
    if (!static_cast<const FileAccess*>(user_data)->allowed) return false;
    engine::OpenFile file(path);
    bytes->resize(file.size());
    file.read(std::span(reinterpret_cast<char*>(bytes->data()), bytes->size()));
    return true;
}

// Later versions of tinygltf have one callback more.
template <class Callbacks>
Callbacks fileCallbacks(FileAccess& access) {
    Callbacks callbacks{};
    callbacks.user_data = &access;
    callbacks.FileExists = isBufferFile;
    callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
    callbacks.ReadWholeFile = readBufferFile;
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                  const std::vector<unsigned char>&, void*) { return false; };
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
        callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string*, const std::string& path,
                                          void* user_data) {
            if (!static_cast<const FileAccess*>(user_data)->allowed) return false;
            *size = engine::OpenFile(path).size();
            return true;
        };
    }
    return callbacks;
}

}  // namespace

tinygltf::Model loadGltf(
    std::span<const std::byte> bytes, const std::filesystem::path& path, GltfImages images,
    GltfMotion motion, const NamedFileCheck& check) {
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (file.size() > std::numeric_limits<std::uint32_t>::max()) fail(0, "4 GiB or more");
    Rewritten other = rewritten(file, images, motion);
    const std::string_view text = other.file ? std::string_view(*other.file) : file;

    tinygltf::TinyGLTF loader;
    FileAccess access{.allowed = !path.empty(), .check = check};
    loader.SetFsCallbacks(fileCallbacks<tinygltf::FsCallbacks>(access));
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
        // tinygltf continues after some errors, without the parts that have them.
        if (!loaded || !error.empty()) throw engine::Error(firstLine(error));
    } catch (const engine::Error&) {
        throw;
    } catch (const std::exception& exception) {
        throw engine::Error("can't be read as glTF: " + reasonIn(exception.what()));
    }
    model.images = std::move(other.images);
    decompress(model, other.compression);
    return model;
}

namespace {

// ---- Gltf accessors -----------------------------------------------------------------------------

// The elements of an accessor in the file, all of them inside their buffer.
struct Elements {
    const tinygltf::Accessor& accessor;
    std::string name;  // for messages
    const unsigned char* first = nullptr;
    std::size_t stride = 0;  // bytes

    template <class Value>
    Value read(std::size_t index) const {
        Value value;
        std::memcpy(&value, first + index * stride, sizeof value);
        return value;
    }

    [[noreturn]] void refuse(const std::string& expected) const {
        throw engine::Error(name, "is not " + expected);
    }
};

// Does not look at the sparse part of the accessor, which must outlive the result.
Elements denseElements(
    const tinygltf::Model& model, const tinygltf::Accessor& accessor, const std::string& name) {
    const tinygltf::BufferView& view = at(model.bufferViews, accessor.bufferView, "buffer view");
    const tinygltf::Buffer& buffer = at(model.buffers, view.buffer, "buffer");
    const int stride = accessor.ByteStride(view);
    const int size =
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)) *
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (stride <= 0 || size <= 0) throw engine::Error(name, "unknown type");
    const auto step = static_cast<std::size_t>(stride);
    const auto width = static_cast<std::size_t>(size);
    const std::size_t available = buffer.data.size();
    const bool view_fits =
        view.byteOffset <= available && view.byteLength <= available - view.byteOffset;
    if (!view_fits || accessor.byteOffset > view.byteLength) {
        throw engine::Error(name, "lies outside its buffer");
    }
    const std::size_t room = view.byteLength - accessor.byteOffset;
    if (accessor.count > 0 && (room < width || (room - width) / step < accessor.count - 1)) {
        throw engine::Error(name, "lies outside its buffer");
    }
    return {accessor, name, buffer.data.data() + view.byteOffset + accessor.byteOffset, step};
}

Elements elementsOf(const tinygltf::Model& model, int index) {
    const std::string name = numbered("accessor", index);
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    if (accessor.sparse.isSparse) throw engine::Error(name, "sparse accessors are not supported");
    return denseElements(model, accessor, name);
}

// Copies the elements unchanged.
template <class Value>
std::vector<Value> copy(const Elements& elements) {
    std::vector<Value> values(elements.accessor.count);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = elements.read<Value>(i);
    return values;
}

// Copies vectors of integers that stand for 0 to 1.
template <class Vector, class Stored>
std::vector<Vector> copyNormalized(const Elements& elements) {
    using Integer = typename Stored::value_type;
    constexpr auto kOne = static_cast<float>(std::numeric_limits<Integer>::max());
    std::vector<Vector> vectors(elements.accessor.count);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = Vector(elements.read<Stored>(i)) / kOne;
    return vectors;
}

// `type` is tinygltf's for Vector.
template <glm::length_t size>
std::vector<glm::vec<size, float>> readShares(const Elements& elements, int type) {
    using Vector = glm::vec<size, float>;
    const tinygltf::Accessor& accessor = elements.accessor;
    const std::string expected =
        "VEC" + std::to_string(size) + " of float, or of normalized unsigned bytes or shorts";
    if (accessor.type != type) elements.refuse(expected);
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT) return copy<Vector>(elements);
    if (!accessor.normalized) elements.refuse(expected);
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copyNormalized<Vector, glm::vec<size, std::uint8_t>>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copyNormalized<Vector, glm::vec<size, std::uint16_t>>(elements);
    default:
        elements.refuse(expected);
    }
}

template <class Integer>
std::vector<std::uint32_t> widen(const Elements& elements) {
    std::vector<std::uint32_t> indices(elements.accessor.count);
    for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = elements.read<Integer>(i);
    return indices;
}

std::vector<std::uint32_t> readUnsigned(const Elements& elements) {
    if (elements.accessor.type != TINYGLTF_TYPE_SCALAR) elements.refuse("SCALAR, for indices");
    switch (elements.accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return widen<std::uint8_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return widen<std::uint16_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return widen<std::uint32_t>(elements);
    default:
        elements.refuse("of unsigned integers, for indices");
    }
}

// Appends the numbers of elements of type Stored to the values.
template <class Stored>
void appendNumbers(const Elements& elements, GltfIntegers integers, GltfNumbers& numbers) {
    constexpr bool kIsFloat = std::is_same_v<Stored, float>;
    if (!kIsFloat && !elements.accessor.normalized && integers == GltfIntegers::normalized)
        elements.refuse("of float, or of normalized integers");
    const double one = !kIsFloat && elements.accessor.normalized
                           ? static_cast<double>(std::numeric_limits<Stored>::max())
                           : 1.0;
    const std::size_t count = elements.accessor.count;
    numbers.values.reserve(numbers.values.size() + count * numbers.components);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t component = 0; component < numbers.components; ++component) {
            Stored value;
            std::memcpy(
                &value, elements.first + i * elements.stride + component * sizeof value,
                sizeof value);
            // The least signed integer stands for -1, too.
            const double number = static_cast<double>(value) / one;
            numbers.values.push_back(one > 1.0 ? std::max(number, -1.0) : number);
        }
    }
}

GltfNumbers numbersOf(const Elements& elements, GltfIntegers integers) {
    const auto type = static_cast<std::uint32_t>(elements.accessor.type);
    GltfNumbers numbers{
        .components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(type)),
        .values = {}};
    switch (elements.accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        appendNumbers<float>(elements, integers, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        appendNumbers<std::int8_t>(elements, integers, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        appendNumbers<std::uint8_t>(elements, integers, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        appendNumbers<std::int16_t>(elements, integers, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        appendNumbers<std::uint16_t>(elements, integers, numbers);
        break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        appendNumbers<std::uint32_t>(elements, integers, numbers);
        break;
    default:
        elements.refuse("of float, or of integers of up to 32 bits");
    }
    return numbers;
}

// Whether vectors of integers are allowed, as KHR_mesh_quantization allows them: 8 or 16 bits,
// perhaps normalized.
bool isQuantized(const tinygltf::Model& model, const Elements& elements) {
    constexpr std::array kTypes{
        TINYGLTF_COMPONENT_TYPE_BYTE, TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE,
        TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT};
    return std::ranges::find(kTypes, elements.accessor.componentType) != kTypes.end() &&
           std::ranges::find(model.extensionsUsed, kQuantization) != model.extensionsUsed.end();
}

template <class Vector>
std::vector<Vector> readQuantized(const Elements& elements) {
    constexpr auto kSize = static_cast<std::size_t>(Vector::length());
    const GltfNumbers numbers = numbersOf(elements, GltfIntegers::whole);
    std::vector<Vector> vectors(elements.accessor.count);
    for (std::size_t i = 0; i < vectors.size(); ++i)
        for (std::size_t axis = 0; axis < kSize; ++axis)
            vectors[i][static_cast<int>(axis)] =
                static_cast<float>(numbers.values[kSize * i + axis]);
    return vectors;
}

void requireFloat(const Elements& elements, int type, const char* expected) {
    if (elements.accessor.type == type &&
        elements.accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT)
        return;
    elements.refuse(expected);
}

}  // namespace

std::optional<int> findAttribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto attribute = primitive.attributes.find(name);
    if (attribute == primitive.attributes.end()) return {};
    return attribute->second;
}

bool hasTriangles(const tinygltf::Primitive& primitive) {
    return primitive.mode == TINYGLTF_MODE_TRIANGLES ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

// glTF 2.0, section 3.6.2.3: a sparse accessor is zeros, or its buffer view's elements, with some
// elements replaced.
GltfNumbers readNumbers(const tinygltf::Model& model, int index, GltfIntegers integers) {
    constexpr std::size_t kMost = std::size_t{1} << 24;  // elements that take no byte of the file
    const std::string name = numbered("accessor", index);
    const tinygltf::Accessor& accessor = at(model.accessors, index, "accessor");
    GltfNumbers numbers;
    if (accessor.bufferView >= 0 || !accessor.sparse.isSparse) {
        numbers = numbersOf(denseElements(model, accessor, name), integers);
    } else {
        const int components =
            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
        if (components <= 0) throw engine::Error(name, "unknown type");
        if (accessor.count > kMost) throw engine::Error(name, "has more than 2^24 elements");
        numbers.components = static_cast<std::size_t>(components);
        numbers.values.assign(accessor.count * numbers.components, 0.0);
    }
    if (!accessor.sparse.isSparse) return numbers;

    const auto& sparse = accessor.sparse;
    tinygltf::Accessor places;
    places.bufferView = sparse.indices.bufferView;
    places.byteOffset = static_cast<std::size_t>(sparse.indices.byteOffset);
    places.componentType = sparse.indices.componentType;
    places.type = TINYGLTF_TYPE_SCALAR;
    places.count = static_cast<std::size_t>(sparse.count);
    tinygltf::Accessor replaced = accessor;
    replaced.bufferView = sparse.values.bufferView;
    replaced.byteOffset = static_cast<std::size_t>(sparse.values.byteOffset);
    replaced.count = places.count;
    const auto elements = readUnsigned(denseElements(model, places, name + "'s sparse indices"));
    const GltfNumbers values =
        numbersOf(denseElements(model, replaced, name + "'s sparse values"), integers);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (elements[i] >= accessor.count || (i > 0 && elements[i] <= elements[i - 1]))
            throw engine::Error(name, "its sparse indices don't ascend, or are past its end");
        std::copy_n(
            values.values.begin() + static_cast<std::ptrdiff_t>(i * values.components),
            values.components,
            numbers.values.begin() + static_cast<std::ptrdiff_t>(elements[i] * values.components));
    }
    return numbers;
}

std::vector<float> readScalars(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    requireFloat(elements, TINYGLTF_TYPE_SCALAR, "SCALAR of float");
    return copy<float>(elements);
}

std::vector<glm::vec3> readVectors(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    if (elements.accessor.type == TINYGLTF_TYPE_VEC3 && isQuantized(model, elements))
        return readQuantized<glm::vec3>(elements);
    requireFloat(elements, TINYGLTF_TYPE_VEC3, "VEC3 of float");
    return copy<glm::vec3>(elements);
}

std::vector<glm::vec3>
readPositions(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const std::optional<int> accessor = findAttribute(primitive, "POSITION");
    if (!accessor) throw engine::Error("no POSITION");
    return readVectors(model, *accessor);
}

std::vector<glm::vec2> readTextureCoordinates(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    if (elements.accessor.type == TINYGLTF_TYPE_VEC2 && isQuantized(model, elements))
        return readQuantized<glm::vec2>(elements);
    return readShares<2>(elements, TINYGLTF_TYPE_VEC2);
}

GltfColors readColors(const tinygltf::Model& model, int accessor) {
    const Elements elements = elementsOf(model, accessor);
    if (elements.accessor.type != TINYGLTF_TYPE_VEC4) {
        return {readShares<3>(elements, TINYGLTF_TYPE_VEC3), {}};
    }
    GltfColors read;
    for (const glm::vec4& color : readShares<4>(elements, TINYGLTF_TYPE_VEC4)) {
        read.colors.emplace_back(color);
        read.opacities.push_back(color.a);
    }
    return read;
}

std::vector<std::uint32_t> readIndices(
    const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::size_t vertex_count) {
    if (primitive.indices < 0) {
        std::vector<std::uint32_t> all(vertex_count);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }
    std::vector<std::uint32_t> indices = readUnsigned(elementsOf(model, primitive.indices));
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < vertex_count) continue;
        throw engine::Error(
            "index " + std::to_string(i) + " names vertex " + std::to_string(indices[i]) +
            ", but there are " + std::to_string(vertex_count));
    }
    return indices;
}

namespace {

// ---- Gltf scene ---------------------------------------------------------------------------------

glm::dmat4 localTransform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());  // both column-major
    glm::dmat4 transform(1.0);
    if (node.translation.size() == 3) {
        transform[3] = glm::dvec4(glm::make_vec3(node.translation.data()), 1.0);
    }
    if (node.rotation.size() == 4) {
        const std::vector<double>& r = node.rotation;  // x, y, z, w
        transform *= glm::mat4_cast(glm::normalize(glm::dquat(r[3], r[0], r[1], r[2])));
    }
    if (node.scale.size() == 3) {
        for (int axis = 0; axis < 3; ++axis)
            transform[axis] *= node.scale[static_cast<std::size_t>(axis)];
    }
    return transform;
}

void visitMesh(
    const tinygltf::Model& model, int node_index, const glm::dmat4& transform, bool is_hidden,
    const std::function<void(const GltfPlace& place)>& visit) {
    const tinygltf::Node& node = at(model.nodes, node_index, "node");
    const tinygltf::Mesh& mesh = at(model.meshes, node.mesh, "mesh");
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        try {
            visit(
                {mesh.primitives[i], transform, node.name.empty() ? mesh.name : node.name,
                 node_index, is_hidden});
        } catch (const engine::Error& error) {
            throw engine::Error(
                numbered("mesh", node.mesh) + ", primitive " + std::to_string(i), error.what());
        }
    }
}

bool hidesItself(const tinygltf::Node& node) {
    const auto extension = node.extensions.find("KHR_node_visibility");
    if (extension == node.extensions.end() || !extension->second.Has("visible")) return false;
    const tinygltf::Value& visible = extension->second.Get("visible");
    return visible.IsBool() && !visible.Get<bool>();
}

// Returns the bytes that one use of a primitive takes once it is read. `available` is the size of
// all buffers; an accessor with more elements is refused elsewhere.
std::uint64_t unfoldedSize(
    const tinygltf::Model& model, const tinygltf::Primitive& primitive, std::uint64_t available) {
    constexpr std::uint64_t kEach = 256;  // bytes of an empty primitive
    constexpr std::uint64_t kElement = 16;  // most bytes of an attribute at a vertex
    std::uint64_t elements = 0;
    const auto add = [&](int accessor) {
        if (accessor < 0 || static_cast<std::size_t>(accessor) >= model.accessors.size()) return;
        const std::size_t count = model.accessors[static_cast<std::size_t>(accessor)].count;
        if (count <= available) elements += count;
    };
    for (const auto& [name, accessor] : primitive.attributes) add(accessor);
    add(primitive.indices);
    return kEach + kElement * elements;
}

// Refuses models whose nodes share so much that the result is far larger than the file.
void checkUnfolding(const tinygltf::Model& model) {
    constexpr std::uint64_t kLeast = 16;  // bytes of JSON for a node, a primitive or an accessor
    std::uint64_t available = 0;
    std::uint64_t in_file = 0;
    for (const tinygltf::Buffer& buffer : model.buffers) {
        available += buffer.data.size();
        in_file += buffer.name == kDecompressed ? 0 : buffer.data.size();
    }
    std::uint64_t size = in_file + kLeast * (model.nodes.size() + model.accessors.size());
    std::vector<std::uint64_t> sizes;
    for (const tinygltf::Mesh& mesh : model.meshes) {
        size += kLeast * mesh.primitives.size();
        sizes.push_back(0);
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            sizes.back() += unfoldedSize(model, primitive, available);
    }
    ExpansionLimit unfolding(size);
    const std::string what = std::to_string(model.nodes.size()) + " nodes with " +
                             std::to_string(model.meshes.size()) + " meshes";
    for (const tinygltf::Node& node : model.nodes)
        if (node.mesh >= 0 && static_cast<std::size_t>(node.mesh) < sizes.size())
            unfolding.add(sizes[static_cast<std::size_t>(node.mesh)], what);
}

}  // namespace

void forEachPrimitive(
    const tinygltf::Model& model, const std::function<void(const GltfPlace& place)>& visit) {
    checkUnfolding(model);
    struct Step {
        int node;
        glm::dmat4 parent;
        bool is_hidden = false;  // by a node above
    };
    if (model.scenes.empty()) throw engine::Error("the file has no scene");
    std::vector<Step> steps;
    for (const int root : at(model.scenes, std::max(model.defaultScene, 0), "scene").nodes) {
        steps.push_back({root, glm::dmat4(1.0)});
    }
    std::vector<bool> visited(model.nodes.size());
    for (std::size_t next = 0; next < steps.size(); ++next) {
        const auto [index, parent, parent_hidden] = steps[next];
        const tinygltf::Node& node = at(model.nodes, index, "node");
        if (visited[static_cast<std::size_t>(index)]) {
            throw engine::Error(numbered("node", index), "is reached twice");
        }
        visited[static_cast<std::size_t>(index)] = true;
        const glm::dmat4 transform = parent * localTransform(node);
        const bool is_hidden = parent_hidden || hidesItself(node);
        if (node.mesh >= 0) visitMesh(model, index, transform, is_hidden, visit);
        for (const int child : node.children) steps.push_back({child, transform, is_hidden});
    }
}

}  // namespace hair::groom
