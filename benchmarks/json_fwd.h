#pragma once

#include <nlohmann/json_fwd.hpp>

namespace benchmarks {

// Members keep the order in which they were written: reports and sweeps are read by people.
using Json = nlohmann::ordered_json;

}  // namespace benchmarks
