#include "tests/benchmarks/schema_errors.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace benchmarks {

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
    for (valijson::ValidationResults::Error error; results.popError(error);) {
        std::string place;
        for (const std::string& token : error.context) place += token;
        errors.push_back(place + ": " + error.description);
    }
    return errors;
}

}  // namespace benchmarks
