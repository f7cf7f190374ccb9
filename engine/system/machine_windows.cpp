#include "engine/system/machine.h"

#include <array>
#include <filesystem>

#include <windows.h>

#include <psapi.h>

namespace engine::system {

namespace fs = std::filesystem;

namespace {

std::uint64_t number(const FILETIME& time) {
    return std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime;
}

// Returns a text below HKEY_LOCAL_MACHINE; empty if there is none.
std::string registryText(const wchar_t* key, const wchar_t* name) {
    std::array<wchar_t, 256> text{};
    DWORD size = sizeof text;
    if (RegGetValueW(HKEY_LOCAL_MACHINE, key, name, RRF_RT_REG_SZ, nullptr, text.data(), &size) !=
        ERROR_SUCCESS)
        return {};
    return fs::path(text.data()).string();
}

}  // namespace

// ---- Names and sizes ----------------------------------------------------------------------------

std::string systemName() {
    // Unlike GetVersionEx(), this does not depend on the manifest.
    using GetVersion = LONG(WINAPI*)(OSVERSIONINFOW*);
    const auto get_version = reinterpret_cast<GetVersion>(
        reinterpret_cast<void*>(GetProcAddress(GetModuleHandleW(L"ntdll.dll"), "RtlGetVersion")));
    OSVERSIONINFOW version{};
    version.dwOSVersionInfoSize = sizeof version;
    if (!get_version || get_version(&version) != 0) return "Windows";
    return "Windows " + std::to_string(version.dwMajorVersion) + '.' +
           std::to_string(version.dwMinorVersion) + '.' + std::to_string(version.dwBuildNumber);
}

std::string processorName() {
    std::string name =
        registryText(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString");
    name.erase(name.find_last_not_of(' ') + 1);
    return name;
}

std::optional<std::uint64_t> memoryBytes() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    if (!GlobalMemoryStatusEx(&status)) return std::nullopt;
    return status.ullTotalPhys;
}

std::tm localTime(std::time_t time) {
    std::tm local{};
    localtime_s(&local, &time);
    return local;
}

// ---- Load and energy ----------------------------------------------------------------------------

std::optional<ProcessorTicks> readProcessorTicks(const fs::path&) {
    FILETIME idle{}, kernel{}, user{};
    if (!GetSystemTimes(&idle, &kernel, &user)) return std::nullopt;
    const std::uint64_t total = number(kernel) + number(user);  // the kernel's has the idle time
    return ProcessorTicks{.busy = total - number(idle), .steal = 0, .total = total};
}

double ticksPerSecond() { return 1e7; }

std::vector<EnergyCounter> readEnergyCounters(const fs::path&) { return {}; }

// ---- How the system runs the processors ---------------------------------------------------------

std::vector<std::string> scalingGovernors(const fs::path&) { return {}; }

std::optional<double> processorQuota(const fs::path&) { return std::nullopt; }

std::optional<bool> onBattery(const fs::path&) {
    constexpr BYTE kNoBattery = 128, kUnknown = 255;
    SYSTEM_POWER_STATUS status{};
    if (!GetSystemPowerStatus(&status) || status.BatteryFlag == kUnknown ||
        (status.BatteryFlag & kNoBattery) || status.ACLineStatus == kUnknown)
        return std::nullopt;
    return status.ACLineStatus == 0;
}

// ---- Libraries ----------------------------------------------------------------------------------

std::vector<std::string> loadedLibraries() {
    std::array<HMODULE, 1024> modules{};
    DWORD size = 0;
    if (!EnumProcessModules(GetCurrentProcess(), modules.data(), sizeof modules, &size)) return {};
    std::vector<std::string> libraries;
    for (std::size_t i = 0; i < modules.size() && i < size / sizeof(HMODULE); ++i) {
        std::array<wchar_t, 1024> path{};
        const auto most = static_cast<DWORD>(path.size());
        if (GetModuleFileNameW(modules[i], path.data(), most) < most)
            libraries.push_back(fs::path(path.data()).generic_string());
    }
    return libraries;
}

Library::Library(const std::string& name) {
    // A name without a folder is one of the system's: nobody's file beside the program.
    const fs::path path = fs::path(name).make_preferred();  // no slash, by LoadLibraryExW()
    handle_ = LoadLibraryExW(
        path.c_str(), nullptr, path.has_parent_path() ? 0 : LOAD_LIBRARY_SEARCH_SYSTEM32);
}

Library::~Library() {
    if (handle_) FreeLibrary(static_cast<HMODULE>(handle_));
}

void* Library::address(const char* name) const {
    if (!handle_) return nullptr;
    return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(handle_), name));
}

const char* const kNvmlLibrary = "nvml.dll";

}  // namespace engine::system
