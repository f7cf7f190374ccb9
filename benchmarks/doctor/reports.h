#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/doctor/checks.h"

// Whether a report may be kept beside others: of a form of ours, and of times that the doctor would
// trust. One that is kept all the same is marked: its member "untrusted" says why.
namespace benchmarks::doctor {

struct ReportExamination {
    std::string schema;  // as the report has it: "hairbench-report/1.5.0"
    std::string device;  // may be empty
    std::size_t cases = 0;  // 0: of a kind that has none
    std::vector<std::string> schema_errors;  // "/cases/0/status: ..."
    // What the doctor's checks say of what the report knows of its build, its layers and, over all
    // cases that ran, of passes, timestamps, clocks and others' load: of each check the worst,
    // where it is `warn` or `bad`.
    std::vector<Finding> findings;
    std::string mark;  // why its times are not to be trusted; empty: it is not marked
};

// Looks at a report of any kind. Throws engine::Error for a file that is none, or is damaged.
ReportExamination examineReport(const std::filesystem::path& file);

// Whether it has the form that its schema says, and nothing is bad or it is marked.
bool isAccepted(const ReportExamination& examination);

// One line: "ok, 16 cases on llvmpipe", or why it is refused.
std::string examinationText(const ReportExamination& examination);

}  // namespace benchmarks::doctor
