#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "benchmarks/scene/json.h"

// Pages in a real browser.
namespace report_page {

// Chromium: what HAIRBENCH_BROWSER names, or one of its usual names in PATH.
std::optional<std::string> findBrowser();

// The page of these reports, as `hairbench report` makes it.
std::string pageOf(std::span<const std::filesystem::path> reports);

// Opens a page, without a network, and takes steps in it: the body of an async JavaScript function,
// which has
//   say(name, value)      into the result
//   settle()              waits until the page has answered to what was done
//   choose(id, value)     from a list
//   type(id, text)        into a box
//   figure(id)            Plotly's traces in it
//   column(table, index)  the texts of a column
// Returns what was said, and `errors`: whatever the console, uncaught errors and the page's
// security policy complained about, and what was asked of the network. A page that never came to
// the end of the steps is a failure of the test.
benchmarks::scene::Json
inBrowser(const std::string& page, const std::string& steps, int width = 1280);

}  // namespace report_page
