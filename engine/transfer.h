#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/buffer_image.h"
#include "engine/commands.h"
#include "engine/error.h"
#include "engine/pictures.h"

// Work that is submitted by itself and waited for: copies of whole buffers and images between host
// and device. For set-up and read-back.

namespace engine {

// Records with `record`, submits, and waits until the work is done.
void runOnce(const Device& device, const std::function<void(Commands&)>& record);

// Fills `destination` from its start and waits until the device has the data. For set-up, not for
// frames.
void upload(const Device& device, std::span<const std::byte> bytes, const Buffer& destination);

// Returns a copy of the buffer's bytes, after all work submitted so far.
std::vector<std::byte> download(const Device& device, const Buffer& source);

// Returns the tightly packed pixels of an image in TRANSFER_SRC_OPTIMAL in a readback buffer, after
// all work submitted so far.
Buffer readImage(const Device& device, const Image& image, std::size_t bytes_per_pixel);

// Returns a buffer that holds the values of a vector, array or span. It has at least one element,
// so that it always has an address.
template <class Values>
Buffer
makeBuffer(const Device& device, const Values& values, const std::string& name, Purpose purpose) {
    Buffer buffer(
        device, {.size = bytesOf<std::ranges::range_value_t<Values>>(values.size()),
                 .name = name,
                 .purpose = purpose});
    if (!values.empty()) upload(device, std::as_bytes(std::span(values)), buffer);
    return buffer;
}

// Returns the buffer of a row with these values. Throws Error if the row has another size.
template <class Values>
Buffer makeBuffer(
    const Device& device, const Values& values, const MemoryRows& rows, std::string_view name) {
    const auto& [row, purpose] = rows.at(name);
    const std::size_t bytes = bytesOf<std::ranges::range_value_t<Values>>(values.size());
    if (!row.at_most && row.size != bytes)
        throw Error(
            "buffer '" + row.name + "'", "has a row of " + std::to_string(row.size) +
                                             " B and contents of " + std::to_string(bytes) + " B");
    return makeBuffer(device, values, row.name, purpose);
}

template <class Value>
std::vector<Value> downloadAs(const Device& device, const Buffer& source) {
    const std::vector<std::byte> bytes = download(device, source);
    std::vector<Value> values(bytes.size() / sizeof(Value));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Value));
    return values;
}

// Meaning of a picture's red, green and blue. Alpha is always linear.
enum class Texels {
    display_color,  // sRGB-encoded
    data,
};

// Returns the picture and its smaller levels (mipmaps), each half as wide and high as the last,
// rounded down, to one pixel. A pixel is the mean of the area it covers; for colours, the mean of
// their linear light.
std::vector<Pixels> textureLevels(Pixels pixels, Texels texels);

// How shaders read a picture's display colours.
enum class Decoding {
    none,  // unchanged
    linear,  // as linear light
};

// A picture on the device with all its mip levels, in SHADER_READ_ONLY_OPTIMAL.
class Texture {
public:
    // `decoding` is for display colours. Throws Unsupported for sizes that the device lacks.
    Texture(
        const Device& device, const Pixels& pixels, Texels texels, Decoding decoding,
        const std::string& name);

    const Image& image() const { return image_; }

private:
    Texture(
        const Device& device, const std::vector<Pixels>& levels, VkFormat format,
        const std::string& name);

    Image image_;
};

}  // namespace engine
