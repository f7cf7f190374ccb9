#pragma once

#include <fstream>

#include <nlohmann/json.hpp>

// Returns scipy's results for stored data. scipy_values.py makes them.
inline const nlohmann::json& scipyValues() {
    static const nlohmann::json values = nlohmann::json::parse(
        std::ifstream(HAIRBENCH_SOURCE_DIR "/tests/decide/scipy_values.json"));
    return values;
}
