#include "engine/transfer.h"

#include <array>
#include <cmath>
#include <utility>

#include "engine/error.h"

namespace engine {

// ---- Copies -------------------------------------------------------------------------------------

void runOnce(const Device& device, const std::function<void(Commands&)>& record) {
    DescriptorSets sets(device);
    device.submitOnce([&](VkCommandBuffer buffer) {
        Commands commands(buffer, sets, device.hazards());
        commands.begin();
        commands.orderAll();
        record(commands);
        commands.orderAll();
        commands.end();
    });
}

void upload(const Device& device, std::span<const std::byte> bytes, const Buffer& destination) {
    const Buffer staging(
        device, {.size = bytes.size(),
                 .usage = Usage::upload,
                 .name = "upload staging",
                 .purpose = "transfers"});
    std::ranges::copy(bytes, staging.mapped().begin());
    runOnce(device, [&](Commands& commands) { commands.copy(staging, destination, bytes.size()); });
}

std::vector<std::byte> download(const Device& device, const Buffer& source) {
    const Buffer staging(
        device, {.size = source.size(),
                 .usage = Usage::readback,
                 .name = "download staging",
                 .purpose = "transfers"});
    runOnce(device, [&](Commands& commands) { commands.copy(source, staging, source.size()); });
    const std::span<std::byte> mapped = staging.mapped();
    return {mapped.begin(), mapped.end()};
}

Buffer readImage(const Device& device, const Image& image, std::size_t bytes_per_pixel) {
    const VkExtent2D extent = image.extent();
    Buffer staging(
        device, {.size = bytes_per_pixel * extent.width * extent.height,
                 .usage = Usage::readback,
                 .name = "picture",
                 .purpose = "transfers"});
    runOnce(device, [&](Commands& commands) { commands.copy(image, staging); });
    return staging;
}

// ---- Textures -----------------------------------------------------------------------------------

namespace {

using Pixel = std::array<double, 4>;

// sRGB's transfer function (IEC 61966-2-1) for every byte.
const std::array<double, 256>& linearOfBytes() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double display = static_cast<double>(i) / 255.0;
            values[i] =
                display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
        }
        return values;
    }();
    return table;
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::lround(255.0 * value)); }

double toDisplay(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Returns the part of source pixel `at`, along one side, that lies in the range.
double overlap(std::uint32_t at, double from, double to) {
    return std::max(0.0, std::min(at + 1.0, to) - std::max(static_cast<double>(at), from));
}

class Averager {
public:
    Averager(const Pixels& source, Texels texels, std::uint32_t width, std::uint32_t height)
        : source_(source), texels_(texels), step_x_(static_cast<double>(source.width) / width),
          step_y_(static_cast<double>(source.height) / height) {}

    Pixel mean(std::uint32_t x, std::uint32_t y) const {
        Pixel sum{};
        const double right = (x + 1) * step_x_;
        const double bottom = (y + 1) * step_y_;
        for (auto v = static_cast<std::uint32_t>(y * step_y_); v < bottom; ++v) {
            const double rows = overlap(v, y * step_y_, bottom);
            for (auto u = static_cast<std::uint32_t>(x * step_x_); u < right; ++u) {
                const double weight = rows * overlap(u, x * step_x_, right);
                add(sum, std::min(u, source_.width - 1), std::min(v, source_.height - 1),
                    weight / (step_x_ * step_y_));
            }
        }
        return sum;
    }

private:
    void add(Pixel& sum, std::uint32_t x, std::uint32_t y, double weight) const {
        const std::size_t first = 4 * (std::size_t{y} * source_.width + x);
        for (std::size_t channel = 0; channel < 4; ++channel) {
            const std::uint8_t byte = source_.rgba[first + channel];
            const bool is_light = texels_ == Texels::display_color && channel < 3;
            sum[channel] += weight * (is_light ? linearOfBytes()[byte] : byte / 255.0);
        }
    }

    const Pixels& source_;
    Texels texels_;
    double step_x_;  // source pixels per pixel, 1 to 3
    double step_y_;
};

Pixels halved(const Pixels& source, Texels texels) {
    Pixels half{std::max(source.width / 2, 1u), std::max(source.height / 2, 1u), {}};
    half.rgba.reserve(std::size_t{4} * half.width * half.height);
    const Averager averager(source, texels, half.width, half.height);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            const Pixel mean = averager.mean(x, y);
            for (std::size_t channel = 0; channel < 4; ++channel) {
                const bool is_light = texels == Texels::display_color && channel < 3;
                half.rgba.push_back(toByte(is_light ? toDisplay(mean[channel]) : mean[channel]));
            }
        }
    }
    return half;
}

ImageDescription describe(
    const Device& device, const std::vector<Pixels>& levels, VkFormat format,
    const std::string& name) {
    const Pixels& largest = levels.front();
    const std::uint32_t most = device.info().limits.maxImageDimension2D;
    if (std::max(largest.width, largest.height) > most) {
        throw Unsupported(
            name, "has " + std::to_string(largest.width) + " by " + std::to_string(largest.height) +
                      " pixels; the device supports at most " + std::to_string(most) + " per side");
    }
    return {
        .format = format,
        .width = largest.width,
        .height = largest.height,
        .levels = static_cast<std::uint32_t>(levels.size()),
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .name = name,
        .purpose = "textures"};
}

VkFormat formatOf(Texels texels, Decoding decoding) {
    return texels == Texels::display_color && decoding == Decoding::linear
               ? VK_FORMAT_R8G8B8A8_SRGB
               : VK_FORMAT_R8G8B8A8_UNORM;
}

}  // namespace

std::vector<Pixels> textureLevels(Pixels pixels, Texels texels) {
    std::vector<Pixels> levels{std::move(pixels)};
    while (levels.back().width > 1 || levels.back().height > 1)
        levels.push_back(halved(levels.back(), texels));
    return levels;
}

Texture::Texture(
    const Device& device, const Pixels& pixels, Texels texels, Decoding decoding,
    const std::string& name)
    : Texture(device, textureLevels(pixels, texels), formatOf(texels, decoding), name) {}

Texture::Texture(
    const Device& device, const std::vector<Pixels>& levels, VkFormat format,
    const std::string& name)
    : image_(device, describe(device, levels, format, name)) {
    std::size_t bytes = 0;
    for (const Pixels& level : levels) bytes += level.rgba.size();
    const Buffer staging(
        device, {.size = bytes, .usage = Usage::upload, .name = name, .purpose = "textures"});
    runOnce(device, [&](Commands& commands) {
        commands.transition(
            image_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        std::size_t offset = 0;
        for (std::uint32_t i = 0; i < levels.size(); ++i) {
            std::ranges::copy(
                std::as_bytes(std::span(levels[i].rgba)),
                staging.mapped().begin() + static_cast<std::ptrdiff_t>(offset));
            commands.copy(staging, offset, image_, i);
            offset += levels[i].rgba.size();
        }
        commands.transition(
            image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
}

}  // namespace engine
