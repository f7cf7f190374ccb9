#include <map>

#include <gmock/gmock.h>

#include "tests/error_text.h"
#include "tests/exporters/exported.h"

namespace benchmarks::report {
namespace {

using testing::ElementsAre;

Report framesAndPasses() {
    Report report = sampleReport();
    report.cases.resize(1);
    report.cases[0].metrics = {
        {ofFrame(Measured::time), {2.0, 4.0}, Mode::overlapped},
        {ofCpu(Measured::record_time), {0.5, 0.25}, Mode::overlapped},
        {ofCpu(Measured::submit_time), {0.125, 0.5}, Mode::overlapped},
        {ofPass("scene", Measured::time), {1.0, 1.5}, Mode::isolated},
        {ofPass("strands", Measured::time), {2.0, 2.5}, Mode::isolated},
        {ofPass("strands", Measured::cpu_time), {1.75, 2.25}, Mode::wall_clock},
        {ofPass("strands", Measured::instructions), {1e6, 1e6}, Mode::wall_clock},
        {ofFrame(Measured::isolated_time), {3.5, 3.75}, Mode::isolated}};
    return report;
}

// Returns "name start+length" in us for each slice of a track.
std::vector<std::string> slices(const scene::Json& trace, int track) {
    std::vector<std::string> found;
    for (const scene::Json& event : trace["traceEvents"])
        if (event["ph"] == "X" && event["tid"] == track)
            found.push_back(
                event["name"].get<std::string>() + ' ' + event["ts"].dump() + '+' +
                event["dur"].dump());
    return found;
}

TEST(Perfetto, LaysFramesOneAfterAnother) {
    const scene::Json trace =
        scene::Json::parse(exportReport(reportJson(framesAndPasses()), "perfetto"));
    EXPECT_THAT(
        slices(trace, 1),
        ElementsAre(
            "frame 0 0.0+3500.0", "scene 0.0+1000.0", "strands 1000.0+2000.0",
            "frame 1 3500.0+4000.0",  // as long as its passes, which is longer than 3.75 ms
            "scene 3500.0+1500.0", "strands 5000.0+2500.0"));
    EXPECT_THAT(
        slices(trace, 2),
        ElementsAre(
            "frame 0 0.0+2000.0", "cpu.record 0.0+500.0", "cpu.submit 500.0+125.0",
            "frame 1 2000.0+4000.0", "cpu.record 2000.0+250.0", "cpu.submit 2250.0+500.0"));
}

// Times must fit into 63 bits of nanoseconds.
TEST(Perfetto, RefusesWhatIsNoTimeOfAFrame) {
    for (const double time : {-1.0, 1e13, 1e300}) {
        Report report = framesAndPasses();
        report.cases[0].metrics[0].samples[1] = time;
        EXPECT_EQ(
            errorText([&] { exportReport(reportJson(report), "perfetto"); }),
            "frame.time: has a sample that is not the time of a frame");
    }
}

TEST(Perfetto, NamesCasesAndTracks) {
    const scene::Json trace = exportedJson("perfetto");
    std::vector<std::string> names;
    for (const scene::Json& event : trace["traceEvents"])
        if (event["ph"] == "M")
            names.push_back(
                event["name"].get<std::string>() + ": " +
                event["args"].begin().value().get<std::string>());
    EXPECT_THAT(
        names, ElementsAre(
                   "process_name: thesis/density:64/backend:tessellation",
                   "thread_name: isolated passes", "thread_name: CPU of overlapped frames",
                   "process_labels: untrusted (other load 50 %, steal 25 %)"));
}

// A viewer shows slices of a track as a stack. It loses a slice that ends after its parent.
TEST(Perfetto, NestsSlicesExactly) {
    Report report = framesAndPasses();
    for (Metric& metric : report.cases[0].metrics)
        for (double& sample : metric.samples) sample /= 3.0;
    const scene::Json trace = scene::Json::parse(exportReport(reportJson(report), "perfetto"));
    std::map<int, double> frame_ends;
    for (const scene::Json& event : trace["traceEvents"]) {
        if (event["ph"] != "X") continue;
        const double start = event["ts"];
        const double end = start + event["dur"].get<double>();
        double& frame_end = frame_ends[event["tid"]];
        if (event["name"].get<std::string>().starts_with("frame"))
            frame_end = end;
        else
            // Both are whole ns, and the rounding of doubles is far below 0.5 ns.
            EXPECT_LE(end, frame_end + 1e-6) << event;
    }
    EXPECT_EQ(frame_ends.size(), 2u);
}

}  // namespace
}  // namespace benchmarks::report
