#pragma once

#include <string>
#include <string_view>

#include "benchmarks/json_fwd.h"
#include "benchmarks/report_page/page_parts.h"

namespace benchmarks {

// Text as HTML shows it, in an element or a quoted attribute.
std::string escapedHtml(std::string_view text);

// JSON that ends no script element and begins no comment in one: "<" is written "\u003c", which is
// the same to JSON. What is no UTF-8 is replaced.
std::string scriptJson(const Json& data);

// The whole page: pageData() in its place. Throws engine::Error for a page without one of the
// places.
std::string assemblePage(const PageParts& parts, const Json& data);

}  // namespace benchmarks
