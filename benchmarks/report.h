#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/axis.h"
#include "benchmarks/json_fwd.h"

// What a run found out, as plain values, and its JSON: the contract with everyone who reads
// reports, described by results/report.schema.json. What is not known is absent there, never 0 or
// "": empty strings, empty optionals, and numbers that are not finite are left out.
namespace benchmarks {

inline constexpr const char* kReportSchema = "hairbench-report/1.0.0";

struct DeviceRecord {
    std::string name;
    std::string type;    // "discrete", "integrated", "virtual", "cpu"
    std::string driver;  // VkPhysicalDeviceDriverProperties::driverName
    std::string driver_version;
    std::string api_version;
    std::optional<double> timestamp_period_ns;
};

struct HostRecord {
    std::string system;
    std::string processor;
    std::optional<std::uint32_t> processor_count;
    std::optional<std::uint64_t> memory_bytes;
};

struct BuildRecord {
    std::string version;
    std::string commit;
    std::string compiler;
    std::string type;  // "Release", ...
};

struct Environment {
    DeviceRecord device;
    HostRecord host;
    BuildRecord build;
    std::vector<std::string> command;
    std::string started;  // UTC, ISO 8601
    std::uint64_t seed = 1;
};

// As reports of any kind write it.
Json environmentJson(const Environment& environment);

struct SceneRecord {
    std::string path;
    std::string hash;      // hashText(document)
    std::string document;  // JSON text: every field, no axis applied
};

// Samples of one quantity; its median, MAD and the rest are worked out when it is written. One
// without a finite sample is left out.
struct Metric {
    std::string name;  // "frame.time", "pass.strands.time", "fps", "memory.device"
    std::string unit;  // "ms", "1/s", "B"
    std::vector<double> samples;
    // "overlapped", "isolated" or "wall_clock" if it was timed in one; never compared across them.
    std::string mode;
};

// A pipeline statistic, and the count that the scene implies.
struct Statistic {
    std::string name;
    std::uint64_t measured = 0;
    std::optional<std::uint64_t> expected;
    std::string note;
};

struct Trust {
    std::optional<double> pass_sum_over_wall;
    std::vector<std::string> warnings;
};

enum class Status { ok, skipped, failed };

struct CaseResult {
    std::string name;
    std::vector<AxisValue> axes;
    Status status = Status::ok;
    std::string reason;  // why it was skipped or failed
    std::vector<Metric> metrics;
    std::vector<Statistic> statistics;
    std::vector<std::pair<std::string, std::uint64_t>>
        counts;  // "guides", "strands", "segments", ...
    Trust trust;
    std::string image_hash;
    std::string state_hash;
};

struct Report {
    Environment environment;
    SceneRecord scene;
    std::vector<CaseResult> cases;
    bool interrupted = false;  // stopped by the user: the cases are those that were done
};

const char* statusName(Status status);

// The report as indented JSON. A scene document or an axis value that is no JSON is our own bug.
std::string reportText(const Report& report);

// Writes the report in one step: whoever opens the file sees the old report or the new one. Creates
// missing folders. Throws engine::Error "<path>: <reason>".
void writeReport(const Report& report, const std::filesystem::path& path);

}  // namespace benchmarks
