#pragma once

#include <string>
#include <vector>

#include "benchmarks/gate/side.h"
#include "benchmarks/scratch_folder.h"

namespace benchmarks {

// Gates of this program against itself, on the doctor's scene.
class OwnGate {
public:
    explicit OwnGate(const engine::DeviceOptions& device);

    // `b_sets`: "POINTER=VALUE" for B's runs alone. Blocks are of one round, some tenths of a
    // second on a software device.
    GateOptions options(std::vector<std::string> b_sets = {}) const;

private:
    ScratchFolder folder_;
    engine::DeviceOptions device_;
    std::filesystem::path scene_;
};

}  // namespace benchmarks
