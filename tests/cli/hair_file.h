#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

// A .hair file by the format's description (Yuksel,
// http://www.cemyuksel.com/research/hairmodels): a header of 128 bytes, then segments per strand
// (uint16) if they differ, then the points.
struct HairFile {
    std::vector<std::uint16_t> segments;  // [strand]
    std::vector<float> points;            // [point][3]
    float thickness = 0.007f;
    std::string_view information = "made for a test";

    std::string text() const {
        constexpr std::uint32_t kSegments = 1;
        constexpr std::uint32_t kPoints = 2;
        std::string file = "HAIR";
        append(file, static_cast<std::uint32_t>(segments.size()));
        append(file, static_cast<std::uint32_t>(points.size() / 3));
        append(file, kSegments | kPoints);
        append(file, std::uint32_t{0});  // segments of all strands, if they don't differ
        append(file, thickness);
        append(file, 0.0f);                                             // transparency
        for (const float channel : {0.5f, 0.25f, 0.125f}) append(file, channel);  // colour
        file += information;
        file.resize(128, '\0');
        for (const std::uint16_t count : segments) append(file, count);
        for (const float coordinate : points) append(file, coordinate);
        return file;
    }

private:
    template <class Value>
    static void append(std::string& file, Value value) {
        char bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        file.append(bytes, sizeof value);
    }
};
