#pragma once

#include <string>

#include <gtest/gtest.h>

#include "hair/settings.h"

namespace hair::simulation {

inline std::string nameOfParallelism(const testing::TestParamInfo<Parallelism>& info) {
    switch (info.param) {
    case Parallelism::vertex:
        return "Vertex";
    case Parallelism::strand:
        return "Strand";
    case Parallelism::serial:
        return "Serial";
    case Parallelism::automatic:
        return "Automatic";
    }
    return "";
}

// Runs a TEST_P suite for each way to spread the `shape` solver over the device.
#define FOR_EVERY_PARALLELISM(SUITE)                                                               \
    INSTANTIATE_TEST_SUITE_P(                                                                      \
        , SUITE, testing::Values(Parallelism::vertex, Parallelism::strand, Parallelism::serial),   \
        nameOfParallelism)

}  // namespace hair::simulation
