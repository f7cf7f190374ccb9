#pragma once

#include <string>
#include <vector>

namespace benchmarks::report {

// What a document breaks of a JSON Schema (draft-07), by an independent validator: a JSON pointer
// with what is wrong there, "/cases/0/status: ...". Both are JSON texts.
std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document);

}  // namespace benchmarks::report
