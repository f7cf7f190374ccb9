#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/python.h"
#include "tests/temporary_folder.h"

// Returns the mean FLIP error of each pair of picture files, reference first. If some are missing,
// fails the test and returns 1 for them. Needs pythonInterpreter().
inline std::vector<double>
flipErrors(const std::vector<std::pair<std::filesystem::path, std::filesystem::path>>& pairs) {
    const TemporaryFolder folder;
    {
        std::ofstream list(folder.path() / "pairs.txt");
        for (const auto& [reference, picture] : pairs)
            list << reference.string() << '\t' << picture.string() << '\n';
    }
    const Outcome outcome =
        runPython("tests/golden/flip.py", "< '" + (folder.path() / "pairs.txt").string() + "'");
    std::vector<double> figures;
    std::istringstream lines(outcome.output);
    for (double figure = 0; lines >> figure;) figures.push_back(figure);
    if (figures.size() != pairs.size()) ADD_FAILURE() << outcome.output;
    figures.resize(pairs.size(), 1.0);
    return figures;
}
