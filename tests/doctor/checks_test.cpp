#include "benchmarks/doctor/checks.h"

#include <set>

#include <gmock/gmock.h>

#include "tests/doctor/sample_facts.h"

namespace benchmarks::doctor {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(DoctorChecks, FindNoFaultWhereThereIsNone) {
    for (const Facts& facts : {goodFacts(), softwareFacts()}) {
        for (const Finding& finding : judgeAll(facts)) {
            EXPECT_EQ(finding.health, Health::ok) << finding.check << ": " << finding.seen;
            EXPECT_THAT(finding.seen, Not(IsEmpty())) << finding.check;
            EXPECT_THAT(finding.advice, IsEmpty()) << finding.check;
        }
    }
}

TEST(DoctorChecks, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (const DoctorCheck& check : doctorChecks()) names.insert(check.name);
    EXPECT_EQ(names.size(), doctorChecks().size());
}

// A fault of an otherwise good machine, and text that its check must contain.
struct Fault {
    const char* check;
    Health health;
    void (*make)(Facts&);
    const char* says;  // part of the finding
    bool software = false;
};

const Fault kFaults[] = {
    {"timestamps", Health::bad, [](Facts& f) { f.timestamps.valid_bits = 0; }, "none"},
    {"timestamps", Health::bad, [](Facts& f) { f.timestamps.step_ns.reset(); }, "advance"},
    {"timestamps", Health::warn, [](Facts& f) { f.timestamps.step_ns = 80000; }, "80000 ns"},
    {"pass sum", Health::bad, [](Facts& f) { f.passes.sum.over_wall = 0.56; }, "56.0 %", true},
    {"pass sum", Health::bad, [](Facts& f) { f.passes.sum.over_wall = 1.2; }, "120.0 %", true},
    {"pass sum", Health::bad,
     [](Facts& f) {
         f.passes.sum.over_device = 0.56;
         f.passes.sum.incomplete = true;
     },
     "56.0 %"},
    {"pass sum", Health::unknown, [](Facts& f) { f.passes.sum.over_wall.reset(); }, "timestamps"},
    {"pass sum", Health::unknown, [](Facts& f) { f.timestamps.valid_bits = 0; }, "timestamps"},
    {"pass times", Health::bad, [](Facts& f) { f.passes.faults = {"pass.wind: off"}; },
     "pass.wind: off"},
    {"pass times", Health::unknown, [](Facts& f) { f.timestamps.valid_bits = 0; }, "timestamps"},
    {"repeatability", Health::bad, [](Facts& f) { f.repeat.same_picture = false; }, "pictures"},
    {"repeatability", Health::bad, [](Facts& f) { f.repeat.same_state = false; }, "states"},
    {"repeatability", Health::bad,
     [](Facts& f) {
         for (double& each : f.repeat.frame) each += 0.1;
     },
     "10.5 % more"},  // exp(0.1) - 1
    {"repeatability", Health::bad,
     [](Facts& f) {
         for (double& each : f.repeat.frame) each -= 0.1;
     },
     "9.5 % less"},  // 1 - exp(-0.1)
    {"noise", Health::warn,
     [](Facts& f) {
         for (double& each : f.repeat.frame) each *= 50;
     },
     "frame time"},
    {"noise", Health::warn,
     [](Facts& f) {
         for (double& each : f.repeat.frame) each *= 50;
         for (double& each : f.repeat.cpu) each *= 100;
     },
     "CPU time", true},
    {"noise", Health::warn,
     [](Facts& f) {
         for (double& each : f.repeat.frame) each *= 50;
     },
     "CPU time", true},
    // A GPU's frames do not depend on the scatter of CPU time.
    {"noise", Health::ok,
     [](Facts& f) {
         for (double& each : f.repeat.cpu) each *= 100;
     },
     "frame time"},
    {"device", Health::ok, [](Facts&) {}, "CPU time", true},
    {"build", Health::bad, [](Facts& f) { f.build.assertions = true; }, "assertions on"},
    {"build", Health::bad, [](Facts& f) { f.build.build.type = "Debug"; }, "Debug"},
    {"build", Health::bad, [](Facts& f) { f.build.build.type = ""; }, "no build type"},
    {"build", Health::bad, [](Facts& f) { f.build.build.flags = "-O3 -fsanitize=address"; },
     "-fsanitize"},
    {"build", Health::ok, [](Facts& f) { f.build.build.type = "RelWithDebInfo"; },
     "RelWithDebInfo"},
    {"build", Health::warn, [](Facts& f) { f.build.build.dirty = true; }, "not as committed"},
    {"layers", Health::bad, [](Facts& f) { f.layers.validation = true; }, "validation"},
    {"layers", Health::bad,
     [](Facts& f) { f.layers.loaded = {"libMangoHud.so", "libVkLayer_khronos_validation.so"}; },
     "validation"},
    {"layers", Health::warn, [](Facts& f) { f.layers.loaded = {"libMangoHud.so"}; }, "MangoHud"},
    {"layers", Health::ok, [](Facts& f) { f.layers.loaded = {"libVkLayer_MESA_device_select.so"}; },
     "device_select"},
    {"clocks", Health::unknown, [](Facts& f) { f.clocks.reset(); }, "neither NVML"},
    {"clocks", Health::bad,
     [](Facts& f) {
         f.clocks->conditions.clock_mhz = 1400;
         f.clocks->conditions.throttle_reasons = {"hardware thermal slowdown"};
     },
     "throttled by hardware thermal slowdown"},
    {"clocks", Health::warn,
     [](Facts& f) { f.clocks->conditions.throttle_reasons = {"power cap"}; }, "power cap"},
    {"clocks", Health::warn,
     [](Facts& f) {
         f.clocks->held = false;
         f.clocks->lowest_mhz = 1200;
     },
     "1200 MHz to 1500 MHz"},
    {"clocks", Health::warn, [](Facts& f) { f.clocks = ClockFacts{}; }, "unknown"},
    {"clocks", Health::warn, [](Facts& f) { f.clocks = ClockFacts{.taken_for_idle = true}; },
     "reports the device as idle"},
    {"processor", Health::unknown, [](Facts& f) { f.processor.governors.clear(); }, "unknown"},
    {"processor", Health::warn,
     [](Facts& f) { f.processor.governors = {"performance", "schedutil"}; }, "schedutil"},
    {"processor", Health::warn, [](Facts& f) { f.processor.quota = 1.5; }, "1.50 of them", true},
    {"processor", Health::ok, [](Facts& f) { f.processor.quota = 1.5; }, "1.50 of them"},
    {"other load", Health::warn, [](Facts& f) { f.load.others = 0.1; }, "10.0 %"},
    {"other load", Health::warn, [](Facts& f) { f.load.others = 0.5; }, "50.0 %"},
    {"other load", Health::bad, [](Facts& f) { f.load.others = 0.5; }, "50.0 %", true},
    {"other load", Health::unknown, [](Facts& f) { f.load.others.reset(); }, "/proc/stat"},
    {"steal", Health::warn, [](Facts& f) { f.load.steal = 0.05; }, "5.0 %"},
    {"steal", Health::bad, [](Facts& f) { f.load.steal = 0.2; }, "20.0 %", true},
    {"steal", Health::unknown, [](Facts& f) { f.load.steal.reset(); }, "/proc/stat"},
    {"power", Health::warn, [](Facts& f) { f.on_battery = true; }, "battery"},
    {"power", Health::unknown, [](Facts& f) { f.on_battery.reset(); }, "no power supply"},
};

TEST(DoctorChecks, SeeEachFault) {
    std::set<std::string> checked;
    for (const Fault& fault : kFaults) {
        Facts facts = fault.software ? softwareFacts() : goodFacts();
        fault.make(facts);
        const Finding finding = findingOf(facts, fault.check);
        EXPECT_EQ(finding.health, fault.health) << fault.check << ": " << finding.seen;
        EXPECT_THAT(finding.seen, HasSubstr(fault.says)) << fault.check;
        // A fault comes with advice.
        if (finding.health == Health::warn || finding.health == Health::bad) {
            EXPECT_THAT(finding.advice, Not(IsEmpty())) << fault.check << ": " << finding.seen;
        }
        checked.insert(fault.check);
    }
    EXPECT_EQ(checked.size(), doctorChecks().size()) << "a check without a fault in this table";
}

TEST(DoctorChecks, SeeAFaultInNoOtherRow) {
    Facts facts = softwareFacts();
    facts.load.steal = 0.2;
    for (const Finding& finding : judgeAll(facts))
        EXPECT_EQ(finding.health, finding.check == "steal" ? Health::bad : Health::ok)
            << finding.check;
}

}  // namespace
}  // namespace benchmarks::doctor
