#pragma once

#include <string>
#include <vector>

namespace benchmarks {

// What a document breaks of a JSON Schema (draft-07), by an independent validator; both are JSON
// texts.
std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document);

}  // namespace benchmarks
