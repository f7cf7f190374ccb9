#include "engine/process_use.h"

#include <ctime>
#include <functional>

#include <linux/perf_event.h>

#include "engine/perf_counter.h"

namespace engine {

namespace {

template <class Operation>
std::optional<double>
both(const std::optional<double>& a, const std::optional<double>& b, Operation operation) {
    if (!a || !b) return std::nullopt;
    return operation(*a, *b);
}

}  // namespace

ProcessUse operator-(const ProcessUse& to, const ProcessUse& from) {
    return {to.cpu - from.cpu, both(to.instructions, from.instructions, std::minus<>())};
}

ProcessUse operator+(const ProcessUse& a, const ProcessUse& b) {
    return {a.cpu + b.cpu, both(a.instructions, b.instructions, std::plus<>())};
}

ProcessUse processUse() {
    static const PerfCounter instructions(PERF_TYPE_HARDWARE, PERF_COUNT_HW_INSTRUCTIONS);
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return {
        static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6,
        instructions.read()};
}

}  // namespace engine
