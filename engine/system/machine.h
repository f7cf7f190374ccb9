#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// Facts about the machine and its system, and libraries that this process loads.
namespace engine::system {

// ---- Names and sizes ----------------------------------------------------------------------------

// "Debian GNU/Linux 12 (bookworm), Linux 6.1.0-30-amd64"
std::string systemName();

// Model of the first processor; empty if the system does not tell.
std::string processorName();

// Installed memory, bytes; absent if the system does not tell.
std::optional<std::uint64_t> memoryBytes();

// Breaks a time down to the calendar and clock of this place.
std::tm localTime(std::time_t time);

// ---- Load and energy ----------------------------------------------------------------------------

// Processor time since the machine started, in ticks (10 ms on most machines). On
// Linux, from the first line of /proc/stat (proc_stat(5)).
struct ProcessorTicks {
    std::uint64_t busy = 0;  // in processes and in the kernel
    std::uint64_t steal = 0;  // given to others by a hypervisor; 0 on Windows
    std::uint64_t total = 0;  // including idle time
};

// Reads the system's own counters, or on Linux those in another file of this format. Absent if they
// are missing or not understood.
std::optional<ProcessorTicks> readProcessorTicks(const std::filesystem::path& path = {});
double ticksPerSecond();

// Energy that a processor package has used since some moment (Linux, powercap's intel-rapl; often
// readable only by the administrator).
struct EnergyCounter {
    std::uint64_t microjoules = 0;
    std::uint64_t range = 0;  // the counter wraps at this value
};

// Reads the counters of all packages, on Linux also those below another folder of this form; empty
// if they are unreadable.
std::vector<EnergyCounter> readEnergyCounters(const std::filesystem::path& folder = {});

// ---- How the system runs the processors ---------------------------------------------------------

// `root` is Linux's root folder.

// Frequency scaling governors of all processors, sorted and without repetition; empty if there is
// no frequency scaling, as in most virtual machines.
std::vector<std::string> scalingGovernors(const std::filesystem::path& root = "/");

// Processor time that a control group grants this process, in processors; absent if it is
// unlimited.
std::optional<double> processorQuota(const std::filesystem::path& root = "/");

// Whether the machine runs on its battery; absent if it has none, or does not tell.
std::optional<bool> onBattery(const std::filesystem::path& root = "/");

// ---- Libraries ----------------------------------------------------------------------------------

// Paths of the libraries in this process.
std::vector<std::string> loadedLibraries();

// A library that is loaded at run time.
class Library {
public:
    explicit Library(const std::string& name);
    ~Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    // Returns null if the library is missing or lacks the function.
    template <class Function>
    Function find(const char* name) const {
        return reinterpret_cast<Function>(address(name));
    }
    template <class Function>
    Function find(const char* name, const char* older_name) const {
        const auto found = find<Function>(name);
        return found ? found : find<Function>(older_name);
    }

private:
    void* address(const char* name) const;

    void* handle_;
};

// Name of NVIDIA's management library, which comes with its driver.
extern const char* const kNvmlLibrary;

}  // namespace engine::system
