#include "engine/float_pictures.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "engine/error.h"
#include "engine/files.h"
#include "engine/pictures.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#include <stb/stb_image.h>

namespace engine {
namespace {

class MemoryInput : public Imf::IStream {
public:
    explicit MemoryInput(std::string_view bytes) : IStream("the file"), bytes_(bytes) {}

    bool read(char out[], int count) override {
        const auto wanted = static_cast<std::size_t>(count);
        if (count < 0 || wanted > bytes_.size() - at_) throw Error("ends too early");
        std::memcpy(out, bytes_.data() + at_, wanted);
        at_ += wanted;
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw Error("ends too early");
        at_ = position;
    }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("a picture") {}

    void write(const char bytes[], int count) override {
        const auto wanted = static_cast<std::size_t>(count);
        if (at_ + wanted > bytes_.size()) bytes_.resize(at_ + wanted);
        std::memcpy(bytes_.data() + at_, bytes, wanted);
        at_ += wanted;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    std::size_t at_ = 0;
};

// Lower bound on bytes per pixel: deflate expands a byte to at most 1032 bytes, and a pixel has at
// least one channel of two bytes.
constexpr std::int64_t kMostPixelsPerByte = 1032 / 2;

// Walks through the attributes of a file's headers (OpenEXR File Layout). OpenEXR allocates an
// attribute's stated size, up to 2 GB, before it reads the value. It reads some types by their
// content rather than by the stated size, and then misreads everything that follows.
class ExrHeaders {
public:
    explicit ExrHeaders(std::string_view file) : rest_(file) {}

    // Throws if OpenEXR would read more or less of an attribute than its size, or past the end.
    void check() {
        take(5);  // the magic number and the first byte of the version
        constexpr unsigned char kManyParts = 0x10;
        const bool has_parts = static_cast<unsigned char>(take(3).front()) & kManyParts;
        for (;;) {
            if (takeName().empty()) {  // the end of a header
                if (!has_parts || rest_.empty() || rest_.front() == '\0') return;
                continue;
            }
            const std::string_view type = takeName();
            const std::size_t size = takeNumber();
            checkValue(type, take(size));
        }
    }

private:
    [[noreturn]] static void fail() { throw Error("ends too early for its header"); }

    std::string_view take(std::size_t size) {
        if (size > rest_.size()) fail();
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }

    std::string_view takeName() {
        constexpr std::size_t kLongest = 255;
        const std::size_t size = rest_.substr(0, kLongest + 1).find('\0');
        if (size == rest_.npos) fail();
        const std::string_view name = take(size);
        take(1);
        return name;
    }

    std::uint32_t takeNumber() {
        const std::string_view bytes = take(sizeof(std::uint32_t));
        std::uint32_t number = 0;
        for (std::size_t i = bytes.size(); i-- > 0;)
            number = number << 8 | static_cast<unsigned char>(bytes[i]);
        return number;
    }

    static void checkValue(std::string_view type, std::string_view value) {
        struct Fixed {
            std::string_view type;
            std::size_t size;
        };
        static constexpr auto kFixed = std::to_array<Fixed>(
            {{"box2f", 16},
             {"box2i", 16},
             {"chromaticities", 32},
             {"compression", 1},
             {"deepImageState", 1},
             {"double", 8},
             {"envmap", 1},
             {"float", 4},
             {"int", 4},
             {"keycode", 28},
             {"lineOrder", 1},
             {"m33d", 72},
             {"m33f", 36},
             {"m44d", 128},
             {"m44f", 64},
             {"rational", 8},
             {"tiledesc", 9},
             {"timecode", 8},
             {"v2d", 16},
             {"v2f", 8},
             {"v2i", 8},
             {"v3d", 24},
             {"v3f", 12},
             {"v3i", 12}});
        const auto fixed = std::ranges::find(kFixed, type, &Fixed::type);
        if (fixed != kFixed.end() && fixed->size != value.size())
            throw Error("its header has a " + std::string(type) + "  of the wrong size");
        ExrHeaders inside(value);
        if (type == "chlist") {
            constexpr std::size_t kChannel = 16;
            while (!inside.takeName().empty()) inside.take(kChannel);
            if (!inside.rest_.empty()) fail();
        } else if (type == "stringvector") {
            while (!inside.rest_.empty()) inside.take(inside.takeNumber());
        } else if (type == "preview") {
            const std::uint64_t width = inside.takeNumber();
            const std::uint64_t height = inside.takeNumber();
            constexpr std::size_t kPixel = 4;
            if (width > inside.rest_.size() || height > inside.rest_.size() ||
                width * height * kPixel != inside.rest_.size())
                fail();
        }
    }

    std::string_view rest_;
};

struct Size {
    std::int64_t width;
    std::int64_t height;
};

Size checkedSize(const Imath::Box2i& window) {
    const Size size{
        std::int64_t{window.max.x} - window.min.x + 1,
        std::int64_t{window.max.y} - window.min.y + 1};
    checkPictureSize(size.width, size.height);
    return size;
}

// Channels of red, green and blue; all the same if there is only luminance.
std::array<const char*, 3> channelsOf(const Imf::ChannelList& channels) {
    std::array names{"R", "G", "B"};
    if (channels.findChannel("Y") && !channels.findChannel("RY") && !channels.findChannel("R"))
        names.fill("Y");
    for (const char* name : names) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (!channel) throw Error(std::string("has no channel ") + name);
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw Error(std::string("channel ") + name + " is subsampled");
    }
    return names;
}

// A channel of interleaved RGB floats. `rgb` is the pixel at the window's corner.
Imf::Slice slice(float* rgb, const Imath::Box2i& window, std::size_t channel) {
    const Size size = checkedSize(window);
    return Imf::Slice::Make(
        Imf::FLOAT, rgb + channel, window, 3 * sizeof(float),
        3 * sizeof(float) * static_cast<std::size_t>(size.width));
}

FloatPixels decode(std::string_view bytes) {
    ExrHeaders(bytes).check();
    MemoryInput stream(bytes);
    Imf::InputFile file(stream, 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    const Imath::Box2i shown = header.displayWindow();
    const Size data_size = checkedSize(window);
    const Size size = checkedSize(shown);
    for (const Size& each : {data_size, size})
        if (each.width * each.height / kMostPixelsPerByte > static_cast<std::int64_t>(bytes.size()))
            throw Error("ends too early for a picture of its size");
    const std::array names = channelsOf(header.channels());

    std::vector<float> data(static_cast<std::size_t>(3 * data_size.width * data_size.height));
    // A channel is read only once: luminance goes to red's place.
    const std::size_t read = std::strcmp(names[0], names[1]) == 0 ? 1 : names.size();
    Imf::FrameBuffer frame;
    for (std::size_t i = 0; i < read; ++i) frame.insert(names[i], slice(data.data(), window, i));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);

    FloatPixels pixels{
        static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
        std::vector<float>(static_cast<std::size_t>(3 * size.width * size.height))};
    const int left = std::max(window.min.x, shown.min.x);
    const int right = std::min(window.max.x, shown.max.x);
    for (int y = std::max(window.min.y, shown.min.y); y <= std::min(window.max.y, shown.max.y); ++y)
        for (int x = left; x <= right; ++x) {
            const float* from = &data[static_cast<std::size_t>(
                3 * ((std::int64_t{y} - window.min.y) * data_size.width + x - window.min.x))];
            float* to = &pixels.rgb[static_cast<std::size_t>(
                3 * ((std::int64_t{y} - shown.min.y) * size.width + x - shown.min.x))];
            for (std::size_t i = 0; i < 3; ++i) to[i] = from[read == 1 ? 0 : i];
        }
    return pixels;
}

FloatPixels decodeExr(std::string_view file) {
    try {
        return decode(file);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        const std::string reason = error.what();
        throw Error("can't be decoded: " + reason.substr(0, reason.find('\n')));
    }
}

// Walks through Radiance's pixels as stb_image reads them (Ward 1991; Radiance's color.c): stb
// never terminates if runs end too early.
class RadiancePixels {
public:
    explicit RadiancePixels(std::string_view file) : rest_(file) {}

    void check(int width, int height) {
        for (std::string_view line = takeLine(); !line.empty(); line = takeLine()) {
        }
        takeLine();  // the size
        constexpr int kLeastOfRuns = 8;
        constexpr int kMostOfRuns = 32768;
        bool has_runs = width >= kLeastOfRuns && width < kMostOfRuns;
        for (int y = 0; y < height && has_runs; ++y) {
            const auto head = std::string_view(rest_).substr(0, 4);
            has_runs = head.size() == 4 && head[0] == 2 && head[1] == 2 && byteOf(head[2]) < 128;
            if (!has_runs && y > 0)
                throw Error("a row does not begin with the mark of run lengths");
            if (!has_runs) break;
            take(4);
            if (byteOf(head[2]) * 256 + byteOf(head[3]) != width)
                throw Error("a row does not have the picture's width");
            for (int channel = 0; channel < 4; ++channel) takeRuns(width);
        }
        if (!has_runs)
            take(
                std::size_t{4} * static_cast<std::size_t>(width) *
                static_cast<std::size_t>(height));
    }

private:
    static int byteOf(char c) { return static_cast<unsigned char>(c); }

    std::string_view take(std::size_t size) {
        if (size > rest_.size()) throw Error("ends too early");
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }

    std::string_view takeLine() {
        const std::size_t size = rest_.find('\n');
        if (size == std::string_view::npos) throw Error("ends too early");
        return take(size + 1).substr(0, size);
    }

    void takeRuns(int width) {
        for (int x = 0; x < width;) {
            const int count = byteOf(take(1)[0]);
            const int pixels = count > 128 ? count - 128 : count;
            if (pixels == 0 || pixels > width - x) throw Error("a run does not fit its row");
            take(count > 128 ? 1 : static_cast<std::size_t>(pixels));
            x += pixels;
        }
    }

    std::string_view rest_;
};

// Decodes Radiance's RGBE.
FloatPixels decodeHdr(std::string_view file) {
    const auto* data = reinterpret_cast<const stbi_uc*>(file.data());
    const int size = static_cast<int>(file.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw Error("is not a Radiance HDR picture");
    checkPictureSize(width, height);
    RadiancePixels(file).check(width, height);
    const std::unique_ptr<float, void (*)(void*)> decoded(
        stbi_loadf_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
    if (!decoded) throw Error(std::string("can't be decoded: ") + stbi_failure_reason());
    const std::size_t values =
        std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {
        static_cast<std::uint32_t>(width),
        static_cast<std::uint32_t>(height),
        {decoded.get(), decoded.get() + values}};
}

}  // namespace

void writeExr(
    const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
    std::span<const float> rgb) {
    assert(rgb.size() == std::size_t{3} * width * height);
    const Imath::Box2i window({0, 0}, {static_cast<int>(width) - 1, static_cast<int>(height) - 1});
    Imf::Header header(window, window);
    Imf::addChromaticities(header, Imf::Chromaticities());  // Rec. 709, the primaries of sRGB
    Imf::FrameBuffer frame;
    constexpr std::array kNames{"R", "G", "B"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
        header.channels().insert(kNames[i], Imf::Channel(Imf::FLOAT));
        frame.insert(kNames[i], slice(const_cast<float*>(rgb.data()), window, i));  // not written
    }
    MemoryOutput stream;
    {
        Imf::OutputFile file(stream, header, 0);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(height));
    }
    writeFileAtomically(path, stream.bytes());
}

FloatPixels decodeFloatImage(std::string_view file) {
    if (file.starts_with("\x76\x2f\x31\x01")) return decodeExr(file);
    if (file.starts_with("#?")) return decodeHdr(file);
    throw Error("is neither OpenEXR nor Radiance HDR");
}

FloatPixels readFloatImage(const std::filesystem::path& path) {
    const std::string bytes = readFile(path);
    try {
        return decodeFloatImage(bytes);
    } catch (const Error& error) {
        throw Error(path.string(), error.what());
    }
}

}  // namespace engine
