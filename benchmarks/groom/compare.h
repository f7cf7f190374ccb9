#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hair/groom/compare.h"
#include "hair/groom/groom.h"
#include "hair/groom/inspect.h"

// Reports of `hairbench groom compare` on two files of hair.
namespace benchmarks::groom {

inline constexpr std::string_view kGroomComparisonSchema = "hairbench-groom-comparison/1.0.0";

// A compared file.
struct ComparedFile {
    std::filesystem::path file;
    std::string_view format;
    hair::groom::Unit unit;  // original unit of its lengths
    hair::groom::StrandSet strands{};  // in metres
};

struct GroomComparison {
    const ComparedFile& first;  // the reference
    const ComparedFile& second;
    const hair::groom::CompareSettings& settings;
    const hair::groom::StrandComparison& found;
};

// Text for a terminal.
std::string groomComparisonText(const GroomComparison& comparison);

// JSON with lengths in metres, shares from 0 to 1, angles in degrees.
std::string groomComparisonJson(const GroomComparison& comparison);

}  // namespace benchmarks::groom
