#include "benchmarks/text_at.h"

#include <nlohmann/json.hpp>

namespace benchmarks {

std::string textAt(const Json& document, const char* pointer) {
    const Json::json_pointer place(pointer);
    if (!document.contains(place)) return {};
    const Json& value = document.at(place);
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace benchmarks
