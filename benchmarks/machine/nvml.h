#pragma once

#include <memory>
#include <string>

#include "benchmarks/machine/clock_source.h"
#include "benchmarks/machine/pci_address.h"

namespace benchmarks {

// The NVIDIA Management Library of the installed driver, found at run time: nothing of it is needed
// to build. Null where there is no such library, it cannot be used, or it does not know the device.
// The base clock is the applications clock: what the board is rated to run at under load, or what
// an administrator chose instead. Boards without one (GeForce) have their greatest clock there,
// as nvbench takes it. It is absent while the driver says that clocks are as they were set.
std::unique_ptr<ClockSource>
openNvml(const PciAddress& address, const std::string& library = "libnvidia-ml.so.1");

}  // namespace benchmarks
