#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "hair/groom/formats/usd_import.h"
#include "tests/python.h"
#include "tests/required.h"
#include "tests/temporary_folder.h"

// points() of make_usd.py.
inline glm::dvec3 madePoint(int k) { return {(k + 1) / 3.0, -k / 7.0, 1e-3 * k * k - 0.1}; }

// Reads the files that make_usd.py writes, once for all tests of a program.
class UsdFiles : public testing::Test {
protected:
    void SetUp() override {
        if (pythonInterpreter().empty()) return skipWithout(Need::python, kNoPython);
    }

    static const std::filesystem::path& folder() {
        static const std::unique_ptr<const TemporaryFolder> made = make();
        return made->path();
    }
    static hair::groom::StrandSet read(const std::string& name) {
        return hair::groom::importUsd({.bytes = {}, .path = folder() / name});
    }

private:
    static std::unique_ptr<const TemporaryFolder> make() {
        auto folder = std::make_unique<const TemporaryFolder>();
        const Outcome made =
            runPython("tests/groom/formats/make_usd.py", "'" + folder->path().string() + "'");
        if (made.status != 0) throw std::runtime_error(made.output);
        return folder;
    }
};
