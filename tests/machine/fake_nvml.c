/* A stand-in for NVIDIA's management library with its C interface. With FAKE_NVML_OLD it has a
   driver's older names and no applications clock; with FAKE_NVML_BARE, only what finds a device. */
#include "fake_nvml.h"

#include <stdio.h>

struct FakeNvml fakeNvml;

static int device;

int nvmlInit_v2(void);
int nvmlShutdown(void);
int nvmlDeviceGetHandleByPciBusId_v2(const char* address, void** handle);

int nvmlInit_v2(void) {
    if (fakeNvml.init_result == 0) ++fakeNvml.users;
    return fakeNvml.init_result;
}

int nvmlShutdown(void) {
    --fakeNvml.users;
    return 0;
}

int nvmlDeviceGetHandleByPciBusId_v2(const char* address, void** handle) {
    snprintf(fakeNvml.address, sizeof fakeNvml.address, "%s", address);
    *handle = &device;
    return fakeNvml.handle_result;
}

#ifndef FAKE_NVML_BARE

/* NVML_ERROR_INVALID_ARGUMENT for another device or kind than is asked for here. */
static int answer(void* handle, int known, int result, unsigned int value, unsigned int* out) {
    if (handle != &device || !known) return 2;
    if (result == 0) *out = value;
    return result;
}

int nvmlDeviceGetClockInfo(void* handle, int clock, unsigned int* megahertz);
int nvmlDeviceGetMaxClockInfo(void* handle, int clock, unsigned int* megahertz);
int nvmlDeviceGetTemperature(void* handle, int sensor, unsigned int* degrees);

int nvmlDeviceGetClockInfo(void* handle, int clock, unsigned int* megahertz) {
    return answer(
        handle, clock == 1 || clock == 2, fakeNvml.clock_result,
        clock == 1 ? fakeNvml.clock : fakeNvml.memory_clock, megahertz);
}

int nvmlDeviceGetMaxClockInfo(void* handle, int clock, unsigned int* megahertz) {
    return answer(handle, clock == 1, 0, fakeNvml.greatest_clock, megahertz);
}

int nvmlDeviceGetTemperature(void* handle, int sensor, unsigned int* degrees) {
    return answer(handle, sensor == 0, 0, fakeNvml.temperature, degrees);
}

struct Utilization {
    unsigned int shaders;
    unsigned int memory;
};
int nvmlDeviceGetPowerUsage(void* handle, unsigned int* milliwatts);
int nvmlDeviceGetTotalEnergyConsumption(void* handle, unsigned long long* millijoules);
int nvmlDeviceGetUtilizationRates(void* handle, struct Utilization* utilization);

int nvmlDeviceGetTotalEnergyConsumption(void* handle, unsigned long long* millijoules) {
    if (handle != &device) return 2;
    if (fakeNvml.energy_result == 0) *millijoules = fakeNvml.millijoules;
    return fakeNvml.energy_result;
}

int nvmlDeviceGetPowerUsage(void* handle, unsigned int* milliwatts) {
    return answer(handle, 1, fakeNvml.clock_result, fakeNvml.milliwatts, milliwatts);
}

int nvmlDeviceGetUtilizationRates(void* handle, struct Utilization* utilization) {
    if (utilization) utilization->memory = 7;
    return answer(handle, 1, fakeNvml.clock_result, fakeNvml.load, &utilization->shaders);
}

#ifdef FAKE_NVML_OLD
#define GET_POWER_LIMIT nvmlDeviceGetPowerManagementLimit
#else
#define GET_POWER_LIMIT nvmlDeviceGetEnforcedPowerLimit
#endif
int GET_POWER_LIMIT(void* handle, unsigned int* milliwatts);

int GET_POWER_LIMIT(void* handle, unsigned int* milliwatts) {
    return answer(handle, 1, fakeNvml.clock_result, fakeNvml.power_limit, milliwatts);
}

#ifdef FAKE_NVML_OLD
#define GET_REASONS nvmlDeviceGetCurrentClocksThrottleReasons
#else
#define GET_REASONS nvmlDeviceGetCurrentClocksEventReasons
int nvmlDeviceGetApplicationsClock(void* handle, int clock, unsigned int* megahertz);

int nvmlDeviceGetApplicationsClock(void* handle, int clock, unsigned int* megahertz) {
    return answer(
        handle, clock == 1, fakeNvml.applications_clock_result, fakeNvml.applications_clock,
        megahertz);
}
#endif

int nvmlDeviceSetGpuLockedClocks(void* handle, unsigned int least, unsigned int most);
int nvmlDeviceResetGpuLockedClocks(void* handle);

int nvmlDeviceSetGpuLockedClocks(void* handle, unsigned int least, unsigned int most) {
    if (handle != &device) return 2;
    if (fakeNvml.lock_result != 0) return fakeNvml.lock_result;
    fakeNvml.locked_least = least;
    fakeNvml.locked_most = most;
    return 0;
}

int nvmlDeviceResetGpuLockedClocks(void* handle) {
    if (handle != &device) return 2;
    fakeNvml.locked_least = fakeNvml.locked_most = 0;
    return 0;
}

int GET_REASONS(void* handle, unsigned long long* reasons);

int GET_REASONS(void* handle, unsigned long long* reasons) {
    if (handle != &device) return 2;
    if (fakeNvml.reasons_result == 0) *reasons = fakeNvml.reasons;
    return fakeNvml.reasons_result;
}

#endif
