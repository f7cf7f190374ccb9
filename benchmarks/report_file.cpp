#include "benchmarks/report_file.h"

#include <nlohmann/json.hpp>

#include "benchmarks/json_text.h"
#include "benchmarks/report.h"
#include "benchmarks/samples_file.h"
#include "engine/error.h"
#include "engine/read_file.h"
#include "engine/write_file.h"

namespace benchmarks {

bool isReadable(std::string_view schema) {
    const std::string_view mine = kReportSchema;
    return schema.starts_with(mine.substr(0, mine.find('.') + 1));
}

Json readReport(const std::filesystem::path& path) {
    Json report = parseJson(engine::readFile(path), path.string());
    const auto schema = report.is_object() ? report.find("schema") : report.end();
    if (!report.is_object() || schema == report.end() || !schema->is_string())
        throw engine::Error(path.string(), "is no report of hairbench run");
    if (!isReadable(schema->get_ref<const std::string&>()))
        throw engine::Error(
            path.string(), schema->get<std::string>() + " is not " + std::string(kReportSchema));
    try {
        moveSamplesIn(report, path);
    } catch (const Json::exception& error) {
        throw engine::Error(path.string(), std::string("is damaged: ") + error.what());
    }
    return report;
}

void writeReport(const Json& report, const std::filesystem::path& path) {
    // What is no file, /dev/stdout or a pipe, has no neighbours.
    std::error_code ignored;
    const bool is_file =
        !std::filesystem::exists(path, ignored) || std::filesystem::is_regular_file(path, ignored);
    Json written = report;
    // Before the report, so that nobody sees it without them.
    const bool moved = is_file && moveSamplesOut(written, path);
    // What drivers and commands say need not be UTF-8.
    engine::writeFileAtomically(
        path, written.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
    if (is_file && !moved) removeSamples(path);
}

}  // namespace benchmarks
