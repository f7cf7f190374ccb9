#include "benchmarks/report/metric.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace benchmarks::report {
namespace {

using enum Better;
using Of = MetricOf;
using What = Measured;

constexpr char kPart = '*';

constexpr MetricKind kKinds[] = {
    {Of::frame, What::rate, "fps", "1/s", higher},
    {Of::frame, What::low_1_percentile, "fps.low_1.percentile", "1/s", higher},
    {Of::frame, What::low_1_mean, "fps.low_1.mean", "1/s", higher},
    {Of::frame, What::low_1_integral, "fps.low_1.integral", "1/s", higher},
    {Of::frame, What::low_0_1_percentile, "fps.low_0_1.percentile", "1/s", higher},
    {Of::frame, What::low_0_1_mean, "fps.low_0_1.mean", "1/s", higher},
    {Of::frame, What::low_0_1_integral, "fps.low_0_1.integral", "1/s", higher},
    {Of::frame, What::device_low_1_percentile, "fps.device_low_1.percentile", "1/s", higher},
    {Of::frame, What::device_low_1_mean, "fps.device_low_1.mean", "1/s", higher},
    {Of::frame, What::device_low_1_integral, "fps.device_low_1.integral", "1/s", higher},
    {Of::frame, What::device_low_0_1_percentile, "fps.device_low_0_1.percentile", "1/s", higher},
    {Of::frame, What::device_low_0_1_mean, "fps.device_low_0_1.mean", "1/s", higher},
    {Of::frame, What::device_low_0_1_integral, "fps.device_low_0_1.integral", "1/s", higher},
    {Of::frame, What::time, "frame.time", "ms", lower},
    {Of::frame, What::device_time, "frame.device.time", "ms", lower},
    {Of::frame, What::first_time, "frame.first.time", "ms", lower},
    {Of::frame, What::isolated_time, "frame.isolated.time", "ms", lower},
    {Of::frame, What::overlap, "frame.overlap", "ms", neither},
    {Of::frame, What::cpu_time, "frame.cpu.time", "ms", lower},
    {Of::frame, What::instructions, "frame.instructions", "1", lower},
    {Of::frame, What::cycles, "frame.cycles", "1", lower},
    {Of::frame, What::energy, "frame.energy", "J", lower},
    {Of::cpu, What::record_time, "cpu.record.time", "ms", lower},
    {Of::cpu, What::submit_time, "cpu.submit.time", "ms", lower},
    {Of::cpu, What::host_time, "cpu.host.time", "ms", lower},
    // A thread waits longer where others are faster.
    {Of::cpu, What::wait_time, "cpu.wait.time", "ms", neither},
    {Of::gpu, What::wait_time, "gpu.wait.time", "ms", neither},
    {Of::pass, What::time, "pass.*.time", "ms", lower},
    {Of::pass, What::cpu_time, "pass.*.cpu.time", "ms", lower},
    {Of::pass, What::instructions, "pass.*.instructions", "1", lower},
    {Of::pass, What::cycles, "pass.*.cycles", "1", lower},
    {Of::image, What::rmse, "image.rmse", "1", lower},
    {Of::image, What::psnr, "image.psnr", "dB", higher},
    {Of::image, What::ssim, "image.ssim", "1", higher},
    {Of::image, What::flip, "image.flip", "1", lower},
    {Of::image, What::flip_tessellation, "image.flip.tessellation", "1", lower},
    {Of::image, What::flip_many_samples, "image.flip.many_samples", "1", lower},
    {Of::memory, What::allocated, "memory.device", "B", lower},
    {Of::memory, What::heap, "memory.heap.*", "B", lower},
    {Of::memory, What::purpose, "memory.purpose.*", "B", lower},
    {Of::memory, What::transparency, "memory.transparency", "B", lower},
    {Of::strands, What::time, "strands.time", "ms", lower},
    {Of::strands, What::time_per_point, "strands.time_per_point", "ns", lower},
    {Of::strands, What::time_per_sample, "strands.time_per_sample", "ns", lower},
    // Counts of a model: more of them is another case, not a worse one.
    {Of::strands, What::bytes, "strands.bytes", "B", neither},
    {Of::strands, What::operations, "strands.*.operations", "1", neither},
    {Of::strands, What::limit, "strands.limit", "ms", neither},
    {Of::strands, What::limit_share, "strands.limit_share", "1", higher},
    {Of::device, What::copy_bandwidth, "device.copy_bandwidth", "GB/s", neither},
    {Of::device, What::arithmetic, "device.*.arithmetic", "GFLOP/s", neither},
    {Of::shader, What::registers, "shader.*.registers", "1", lower},
    {Of::shader, What::scalar_registers, "shader.*.scalar_registers", "1", lower},
    {Of::shader, What::spills, "shader.*.spills", "1", lower},
    {Of::shader, What::scalar_spills, "shader.*.scalar_spills", "1", lower},
    {Of::shader, What::scratch, "shader.*.scratch", "B", lower},
    {Of::shader, What::waves, "shader.*.waves", "1", higher},
    {Of::shader, What::instructions, "shader.*.instructions", "1", lower},
    {Of::shader, What::code_size, "shader.*.code_size", "B", lower},
    {Of::shader, What::shared_memory, "shader.*.shared_memory", "B", lower},
    {Of::shader, What::latency, "shader.*.latency", "cycles", lower},
    {Of::shader, What::inverse_throughput, "shader.*.inverse_throughput", "cycles", lower},
    // Samples are of successive frames.
    {Of::probe, What::time, "probe.pass.time", "ms", lower},
    {Of::probe, What::simulated_time, "probe.time", "s", neither},
    {Of::probe, What::tip_displacement, "probe.tip_displacement.*", "m", neither},
    {Of::probe, What::groom_distance, "probe.groom_distance.*", "m", neither},
    {Of::probe, What::length_error, "probe.length_error.*", "1", lower},
    {Of::probe, What::kinetic_energy, "probe.kinetic_energy", "J", neither},
    {Of::probe, What::gravitational_energy, "probe.gravitational_energy", "J", neither},
    {Of::probe, What::elastic_energy, "probe.elastic_energy", "J", neither},
    {Of::probe, What::contacts, "probe.contacts", "count", neither},
    {Of::probe, What::penetration, "probe.penetration", "m", lower},
    {Of::probe, What::speed, "probe.speed", "m/s", neither},
    {Of::probe, What::bending, "probe.bending.*", "deg", neither},
    {Of::probe, What::torsion, "probe.torsion.*", "deg", neither},
    {Of::probe, What::momentum, "probe.momentum.*", "kg m/s", neither},
};

// Returns null for MetricOf::other.
const MetricKind* kindOf(const MetricId& id) {
    const auto found = std::ranges::find_if(
        kKinds, [&](const MetricKind& kind) { return kind.of == id.of && kind.what == id.what; });
    assert((found == std::end(kKinds)) == (id.of == Of::other));
    return found == std::end(kKinds) ? nullptr : found;
}

// Returns the text in the place of the pattern's '*', empty for a pattern without one. Returns
// nothing if the name does not match.
std::optional<std::string> partOf(std::string_view name, std::string_view pattern) {
    const std::size_t place = pattern.find(kPart);
    if (place == pattern.npos) return name == pattern ? std::optional(std::string()) : std::nullopt;
    const std::string_view before = pattern.substr(0, place);
    const std::string_view after = pattern.substr(place + 1);
    if (name.size() < pattern.size() || !name.starts_with(before) || !name.ends_with(after))
        return std::nullopt;
    const std::string_view part =
        name.substr(before.size(), name.size() - before.size() - after.size());
    if (part.find('.') != part.npos) return std::nullopt;
    return std::string(part);
}

Better betterNamed(std::string_view name) {
    for (const Better better : {lower, higher})
        if (name == betterName(better)) return better;
    return neither;
}

Mode modeNamed(std::string_view name) {
    for (const Mode mode : {Mode::none, Mode::overlapped, Mode::isolated, Mode::wall_clock})
        if (name == modeName(mode)) return mode;
    return Mode::other;
}

bool isOfFrameOrPass(const MetricId& id) { return id.of == Of::frame || id.of == Of::pass; }

}  // namespace

std::span<const MetricKind> metricKinds() { return kKinds; }

std::string MetricId::name() const {
    const MetricKind* const kind = kindOf(*this);
    if (!kind) return part;
    std::string name(kind->name);
    if (const std::size_t place = name.find(kPart); place != name.npos)
        name.replace(place, 1, part);
    return name;
}

MetricId metricNamed(std::string_view name) {
    for (const MetricKind& kind : kKinds)
        if (std::optional<std::string> part = partOf(name, kind.name))
            return {kind.of, kind.what, std::move(*part)};
    return {Of::other, What::other, std::string(name)};
}

bool isProbe(const MetricId& id) { return id.of == Of::probe && id.what != What::time; }

bool isPassTime(const MetricId& id) { return id.of == Of::pass && id.what == What::time; }

bool isFrameOrPassTime(const MetricId& id) { return isOfFrameOrPass(id) && id.what == What::time; }

bool isOfProcessor(const MetricId& id) {
    return isOfFrameOrPass(id) && (id.what == What::cpu_time || id.what == What::instructions);
}

bool isFrameOrPassCost(const MetricId& id) { return isFrameOrPassTime(id) || isOfProcessor(id); }

bool isSameOfFrameOrPass(const MetricId& id, const MetricId& other) {
    return isOfFrameOrPass(id) && id.what == other.what;
}

Metric::Metric(MetricId metric_id, std::vector<double> values, Mode timed)
    : id(std::move(metric_id)), mode(timed), samples(std::move(values)) {
    if (const MetricKind* const kind = kindOf(id)) {
        unit = kind->unit;
        better = kind->better;
    }
}

std::vector<double> samplesIn(const scene::Json& samples) {
    std::vector<double> numbers;
    numbers.reserve(samples.size());
    for (const scene::Json& each : samples)
        numbers.push_back(
            each.is_null() ? std::numeric_limits<double>::quiet_NaN() : each.get<double>());
    return numbers;
}

MetricReading MetricReading::fromReport(std::string_view name, const scene::Json& entry) {
    MetricReading reading{{metricNamed(name), {}, modeNamed(entry.value("mode", ""))}};
    reading.unit = entry.at("unit").get<std::string>();
    reading.better = betterNamed(entry.value("hint", betterName(reading.better)));
    reading.median = entry.at("median").get<double>();
    if (const auto samples = entry.find("samples"); samples != entry.end())
        reading.samples = samplesIn(*samples);
    return reading;
}

std::vector<MetricReading> readMetrics(const scene::Json& result) {
    std::vector<MetricReading> metrics;
    for (const auto& [name, entry] : result.at("metrics").items())
        metrics.push_back(MetricReading::fromReport(name, entry));
    return metrics;
}

const char* betterName(Better better) {
    switch (better) {
    case lower:
        return "lower";
    case higher:
        return "higher";
    case neither:
        break;
    }
    return "";
}

const char* modeName(Mode mode) {
    switch (mode) {
    case Mode::overlapped:
        return "overlapped";
    case Mode::isolated:
        return "isolated";
    case Mode::wall_clock:
        return "wall_clock";
    case Mode::other:
        return "other";
    case Mode::none:
        break;
    }
    return "";
}

}  // namespace benchmarks::report
