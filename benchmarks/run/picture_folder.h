#pragma once

#include <filesystem>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// Removes the pictures that older runs left beside the report (case_picture.h) and that it does
// not name.
void removeOtherPictures(const Json& report, const std::filesystem::path& path);

}  // namespace benchmarks
