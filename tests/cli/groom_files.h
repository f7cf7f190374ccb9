#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/hair_file.h"
#include "tests/cli/run_hairbench.h"
#include "tests/temporary_folder.h"

// Four strands in centimetres: 10, 10, 20 and 30 cm long, up from the corners of a square.
inline HairFile fourStrands() {
    return {.segments = {2, 2, 2, 3}, .points = {0, 0, 0, 0, 5,  0, 0, 10, 0,   //
                                                 4, 0, 0, 4, 5,  0, 4, 10, 0,   //
                                                 0, 0, 4, 0, 10, 4, 0, 20, 4,   //
                                                 4, 0, 4, 4, 10, 4, 4, 20, 4, 4, 30, 4}};
}

// Returns this many strands of 16 points on a lattice.
inline HairFile lawn(std::uint32_t strands) {
    HairFile file{.segments = std::vector<std::uint16_t>(strands, 15)};
    file.points.reserve(std::size_t{strands} * 48);
    for (std::uint32_t i = 0; i < strands; ++i)
        for (int k = 0; k < 16; ++k)
            for (const float coordinate :
                 {0.1f * static_cast<float>(i % 256), 0.7f * static_cast<float>(k),
                  0.1f * static_cast<float>(i / 256)})
                file.points.push_back(coordinate);
    return file;
}

// Has a folder for files of hair, and runs `hairbench groom` on them.
class GroomCli : public testing::Test {
protected:
    std::string quoted(std::string_view name) const {
        return "'" + folder_.file(name).string() + "'";
    }
    Outcome info(std::string_view name, const std::string& options = "") const {
        return hairbench("groom info " + quoted(name) + " " + options);
    }
    nlohmann::json json(std::string_view name, const std::string& options = "") const {
        return nlohmann::json::parse(info(name, "--json " + options).output);
    }
    Outcome
    convert(std::string_view in, std::string_view out, const std::string& options = "") const {
        return hairbench("groom convert " + quoted(in) + " " + quoted(out) + " " + options);
    }
    // Returns the data after the header of a .hair file.
    std::string dataOf(std::string_view name) const {
        return textOf(folder_.file(name)).substr(128);
    }

    TemporaryFolder folder_;
};
