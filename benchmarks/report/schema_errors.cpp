#include "benchmarks/report/schema_errors.h"

#include <string_view>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace benchmarks::report {
namespace {

// valijson's tokens are <root>, [name] and [number]. Some releases put names in quotes.
std::string pointerOf(const std::vector<std::string>& context) {
    std::string pointer;
    for (std::string_view token : context) {
        if (!token.starts_with('[')) continue;
        token = token.substr(1, token.size() - 2);
        if (token.starts_with('"')) token = token.substr(1, token.size() - 2);
        pointer.append("/").append(token);
    }
    return pointer;
}

}  // namespace

std::vector<std::string> schemaErrors(const std::string& schema, const std::string& document) {
    using Adapter = valijson::adapters::NlohmannJsonAdapter;
    const auto schema_json = nlohmann::json::parse(schema);
    const auto document_json = nlohmann::json::parse(document);
    valijson::Schema compiled;
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(Adapter(schema_json), compiled);
    valijson::ValidationResults results;
    valijson::Validator().validate(compiled, Adapter(document_json), &results);
    std::vector<std::string> errors;
    for (valijson::ValidationResults::Error error; results.popError(error);)
        errors.push_back(pointerOf(error.context) + ": " + error.description);
    return errors;
}

}  // namespace benchmarks::report
