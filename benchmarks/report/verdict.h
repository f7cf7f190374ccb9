#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"

// Says how far times can be trusted. `run`, `doctor` and everything that shows a report use these
// rules. They need only what a report contains, so a report of an earlier build is judged by them
// too.
namespace benchmarks::report {

enum class Trusted {
    trusted,
    doubtful,  // the times can be used with care
    untrusted,
};

// "trusted", "doubtful", "untrusted".
const char* trustedName(Trusted level);

// ---- Rules --------------------------------------------------------------------------------------

// How far timings may be off and still be believed, as a ratio.
inline constexpr double kTrustTolerance = 0.1;

// Shares of all processors' time above which others disturb, and above which they dominate.
inline constexpr double kLittleLoad = 0.05;
inline constexpr double kMuchLoad = 0.25;
inline constexpr double kLittleSteal = 0.01;
inline constexpr double kMuchSteal = 0.1;

// A median with a wider 95 % interval, half of it over the median, is doubtful.
inline constexpr double kWideInterval = 0.05;

// Whether the device in a report's environment is the processor itself, so that CPU time measures
// the cost of passes.
bool isSoftwareDevice(const scene::Json& environment);

// Whether other programs' work on the processors slows a device of this type. A software device is
// made of them, and an integrated GPU shares their power limit and memory.
bool sharesProcessors(std::optional<engine::DeviceType> device_type);

// `share` of all processors' time that other programs used. On a device that shares the processors
// this disturbs the frames. On others it disturbs only their recording, and times are never worse
// than doubtful.
Trusted judgeOtherLoad(double share, bool shares_processors);

// `share` of all processors' time that the hypervisor gave to others. This disturbs the frames of a
// software device, and only the recording of others'.
Trusted judgeSteal(double share, bool software);

// Compiler flags and build type, as in a report. Times need a release build without sanitizers.
Trusted judgeBuild(const BuildRecord& build);

// The sum of isolated passes over the time that they have to add up to.
Trusted judgePassSum(double sum);

// The device's clock over a whole case: throttled, or limited for another reason of the driver's.
Trusted judgeClock(const Conditions& conditions);

// The board's limits of power and of current as throttle reasons.
inline constexpr const char* kPowerCap = "power cap";
inline constexpr const char* kCurrentLimit = "current limit";

// True if a driver's throttle reason is heat or power. Others, like a clock that somebody set, are
// not throttling.
bool isHeatOrPower(std::string_view reason);

// True if the device reports that it almost always had work.
bool isFullyLoaded(const Conditions& round);

// The rounds of a mode give the device the same work. A clock below this share of the highest in
// any round is throttled.
inline constexpr double kHeldShare = 0.9;
// Other cases may draw more power and reach another clock. A clock under full load below this share
// of the highest in any case is throttled (nvbench's share).
inline constexpr double kThrottledShare = 0.75;

// A board at its limit of power or current works as intended while its clock is steady. With such a
// reason, a clock below this share of the highest is throttled.
inline constexpr double kCappedShare = 0.97;

// The highest clocks of a device that are known so far, MHz; 0: unknown.
struct HighestClocks {
    double shaders = 0.0;
    double memory = 0.0;

    // Raises both to the round's medians.
    void raise(const Conditions& round);
    void raise(const HighestClocks& others);
};

// True if heat or power lowered a clock of the device in a round, by its driver's reasons, the low
// shader clock under load, or the memory's clock; a single low reading is no throttling. `held` are
// the highest clocks of the mode's rounds, `held_before` those of other cases of the run. The
// board's base clock is not used, because locked clocks may be below it. Nor is the greatest memory
// clock, because drivers keep memory below it for compute.
bool isThrottled(
    const Conditions& round, const HighestClocks& held, const HighestClocks& held_before);

// ---- Verdict on a case --------------------------------------------------------------------------

// A reason to trust a case's times less.
struct Doubt {
    std::string check;  // row of `hairbench doctor`, or "drift"
    Trusted level = Trusted::doubtful;
    std::string brief;  // for a table: "other load 73 %"
    std::string text;  // "73.0 % of all processors' time was used by others"
    double size = 0.0;  // the greatest of a check is the worst
};

struct CaseVerdict {
    Trusted level = Trusted::trusted;
    std::vector<Doubt> doubts;  // the worst first
};

// Returns the verdict on a case of a report. `environment` is the report's member. Unknown facts
// raise no doubt, except that a median without an interval does. Returns nothing for a case that
// was skipped or failed, or was only compiled. A verdict in the case itself is not used: reports of
// all builds are judged by the same rules.
std::optional<CaseVerdict> judgeCase(const scene::Json& environment, const scene::Json& result);

// Half the interval of the median frame time over that median: the column "+-" of tables. Absent
// without an interval.
std::optional<double> relativeHalfInterval(const scene::Json& result);

// The build's and the layers' doubts, which all cases of a report share.
std::vector<Doubt> judgeEnvironment(const scene::Json& environment);

// "trusted", "untrusted (other load 73 %, noise 12 %)": reasons of that level alone.
std::string verdictText(const CaseVerdict& verdict);

// All reasons as one text: "other load: 73.0 % of ...; drift: ...".
std::string reasonsText(const CaseVerdict& verdict);

// Verdict and reasons as a case has them in /trust: {"verdict", "reasons": ["other load: ..."]}.
scene::Json verdictJson(const CaseVerdict& verdict);

// Sets these members of the case, if it has a verdict. They are for programs that only read the
// file.
void putVerdict(const scene::Json& environment, scene::Json& result);

// The verdicts on all cases of a report, counted. Keeps no case.
class Verdicts {
public:
    void add(const scene::Json& environment, const scene::Json& result);

    std::size_t count(Trusted level) const;
    Trusted worst() const;
    // "5 trusted, 11 doubtful"; empty without a case that ran.
    std::string counts() const;
    // One line on the cases that are not trusted, with the worst of the reasons that most of them
    // share; empty if all are.
    std::string summary() const;

private:
    struct Shared {
        std::size_t cases = 0;
        Doubt worst;
    };
    std::map<Trusted, std::size_t> counts_;  // of levels that a case has
    std::map<std::pair<Trusted, std::string>, Shared> shared_;  // by level and check of a doubt
};

Verdicts verdictsOf(const scene::Json& report);

}  // namespace benchmarks::report
