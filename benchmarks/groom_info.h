#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/groom_oddities.h"
#include "hair/groom/inspect.h"
#include "hair/groom/strand_set.h"

namespace benchmarks {

// What `hairbench groom info` has to say of a file.
struct GroomInfo {
    std::filesystem::path file;
    std::string_view format;
    const hair::StrandSet& strands;
    const hair::StrandFindings& findings;
    std::vector<Oddity> oddities;
};

inline constexpr std::string_view kGroomSchema = "hairbench-groom/1.0.0";

// For a terminal; what is odd comes last.
std::string groomInfoText(const GroomInfo& info);

// The same as JSON. Lengths are in metres; what is not known is absent.
std::string groomInfoJson(const GroomInfo& info);

}  // namespace benchmarks
