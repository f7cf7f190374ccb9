#include "benchmarks/doctor/pass_metric.h"

namespace benchmarks {

namespace {

constexpr const char kPass[] = "pass.";

// ".cpu.time", ".instructions" or ".time".
std::string quantityOf(const std::string& metric) {
    for (const char* const quantity : {".cpu.time", ".instructions", ".time"})
        if (metric.ends_with(quantity)) return quantity;
    return {};
}

}  // namespace

std::string passOf(const std::string& metric) {
    const std::string quantity = quantityOf(metric);
    if (!metric.starts_with(kPass) || quantity.empty()) return {};
    const std::size_t begin = sizeof kPass - 1;
    return metric.substr(begin, metric.size() - begin - quantity.size());
}

std::string sameOfAllPasses(const std::string& metric) {
    std::string escaped;
    for (const char each : quantityOf(metric))
        escaped += each == '.' ? std::string("\\.") : std::string{each};
    return R"(^(frame|pass\.[^.]+))" + escaped + '$';
}

}  // namespace benchmarks
