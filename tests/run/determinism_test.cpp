// Tests that each case of a sweep always gives the same picture and state, however it is run.
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/run/tiny_sweep.h"

namespace benchmarks::run {
namespace {

// Picture and state hashes of a report's cases.
using Hashes = std::map<std::string, std::pair<std::string, std::string>>;

class Determinism : public TinySweep {
protected:
    Hashes played(const std::vector<std::string>& more = {}, const std::string& variables = "") {
        const std::filesystem::path out = folder_.file("played.json");
        std::filesystem::remove(out);
        std::string call = variables + " '" HAIRBENCH_PROGRAM "'";
        // Gusts of wind, hair-hair contact and a moving head may depend on the order of threads. A
        // run must not resume an earlier journal.
        for (const std::string& each : arguments(
                 out, {"--set", "/simulation/wind/strength=8", "--set",
                       "/simulation/hair_hair/friction=0.2", "--set", "/run/frames=12", "--filter",
                       "msaa:1/density:[36]$"}))
            call += " '" + each + "'";
        for (const std::string& each : more) call += " '" + each + "'";
        const Outcome outcome = runInShell(call + " 2>&1");
        EXPECT_EQ(outcome.status, 0) << call << '\n' << outcome.output;
        Hashes hashes;
        if (outcome.status != 0) return hashes;
        const scene::Json report = report::readReport(out);
        for (const scene::Json& each : report["cases"])
            if (each["status"] == "ok")
                hashes[each["name"]] = {each["image_hash"], each["state_hash"]};
        return hashes;
    }
};

TEST_F(Determinism, OfRunsThreadsVectorsAndFramesInFlight) {
    const Hashes first = played();
    ASSERT_EQ(first.size(), 2u);
    const char* const wanted = std::getenv("HAIRBENCH_RUNS");
    const int runs = wanted ? std::atoi(wanted) : 3;
    for (int i = 1; i < runs; ++i) EXPECT_EQ(played(), first);
    for (const char* const frames : {"1", "3", "4"})
        EXPECT_EQ(played({"--set", std::string("/run/frames_in_flight=") + frames}), first);
    // Numbers of lavapipe's threads beside the recording one, and bits of its vectors.
    for (const char* const variable :
         {"LP_NUM_THREADS=0", "LP_NUM_THREADS=1", "LP_NUM_THREADS=5", "LP_NATIVE_VECTOR_WIDTH=128"})
        EXPECT_EQ(played({}, variable), first) << variable;
}

}  // namespace
}  // namespace benchmarks::run
