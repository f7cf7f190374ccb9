#pragma once

#include <fstream>

#include <nlohmann/json.hpp>

// What scipy says of stored data: scipy_values.py beside it says how the numbers were made.
inline const nlohmann::json& scipyValues() {
    static const nlohmann::json values = nlohmann::json::parse(
        std::ifstream(HAIRBENCH_SOURCE_DIR "/tests/decide/scipy_values.json"));
    return values;
}
