#include "benchmarks/command_line/command_line.h"
#include "benchmarks/exporters/exporters.h"

namespace benchmarks {

namespace {

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const Exporter& each : exporters()) names.emplace_back(each.name);
    return names;
}

std::string formatNotes() {
    std::string text = "Formats:";
    for (const Exporter& each : exporters())
        text += "\n  " + std::string(each.name) + ": " + each.description;
    return text;
}

void addCompareOptions(CLI::App& command, CompareOptions& options) {
    command.add_option("a", options.a, "report to compare with")->type_name("A");
    command.add_option("b", options.b, "report that may be slower")->type_name("B");
    command
        .add_option(
            "--baseline", options.baseline, "the report that run --save-baseline kept, for A")
        ->type_name("NAME");
    command.add_flag("--all", options.all, "also what stayed the same");
    command.add_flag("--json", options.json, "as JSON");
    addVerdictOptions(command, options.verdict);
}

}  // namespace

void addReportCommands(const CommandLine& line) {
    addCommand<CompareOptions>(
        line, line.app, "compare", "compares two reports", compareReports, addCompareOptions);
    addCommand<ReportPageOptions>(
        line, line.app, "report", "makes a page of reports (.html) that opens offline",
        writeReportPage, [](CLI::App& command, ReportPageOptions& options) {
            command.add_option("reports", options.reports, "reports; the first is compared with")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "page to write (.html)")
                ->required()
                ->type_name("FILE");
        });
    addCommand<ConvertReportOptions>(
        line, line.app, "convert", "writes a report in the format of another tool", convertReport,
        [](CLI::App& command, ConvertReportOptions& options) {
            command.add_option("report", options.report, "report")->required()->type_name("FILE");
            command.add_option("-f,--format", options.format, "see below")
                ->required()
                ->check(CLI::IsMember(formatNames()));
            command.add_option("-o,--out", options.out, "file to write (default stdout)")
                ->type_name("FILE");
            command.footer(formatNotes());
        });
    addCommand<MergeOptions>(
        line, line.app, "merge", "joins the reports of a sweep's shards", mergeReports,
        [](CLI::App& command, MergeOptions& options) {
            command.add_option("reports", options.reports, "reports of the shards")
                ->required()
                ->type_name("FILE...");
            command.add_option("-o,--out", options.out, "report to write")
                ->required()
                ->type_name("FILE");
            command.add_flag(
                "--force", options.force, "join what is of other scenes, builds, devices");
        });
}

}  // namespace benchmarks
