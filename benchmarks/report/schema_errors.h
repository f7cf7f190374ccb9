#pragma once

#include <string>
#include <vector>

namespace benchmarks::report {

// Returns the errors of a document against a JSON Schema (draft-07), by an independent validator.
// Each is a JSON pointer with a description, "/cases/0/status: ...". Both arguments are JSON texts.
std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document);

}  // namespace benchmarks::report
