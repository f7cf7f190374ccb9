#include "benchmarks/report_page/assemble_page.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace benchmarks {

namespace {

std::string replaced(std::string_view text, char what, std::string_view with) {
    std::string result;
    for (const char each : text)
        if (each == what)
            result += with;
        else
            result += each;
    return result;
}

}  // namespace

std::string escapedHtml(std::string_view text) {
    std::string result = replaced(text, '&', "&amp;");
    result = replaced(result, '<', "&lt;");
    result = replaced(result, '>', "&gt;");
    return replaced(result, '"', "&quot;");
}

std::string scriptJson(const Json& data) {
    return replaced(data.dump(-1, ' ', false, Json::error_handler_t::replace), '<', "\\u003c");
}

std::string assemblePage(const PageParts& parts, const Json& data) {
    const std::string title =
        escapedHtml(data.at("title").get_ref<const std::string&>()) + " - hairbench";
    const std::string json = scriptJson(data);
    // In the order of the page, so that what is put in is never searched.
    const std::pair<std::string_view, std::string_view> places[] = {
        {"@title@", title},
        {"@style@", parts.style},
        {"@data@", json},
        {"@plotly@", parts.plotly},
        {"@script@", parts.script}};
    std::string_view rest = parts.page;
    std::string page;
    page.reserve(parts.page.size() + parts.plotly.size() + parts.script.size() + json.size());
    for (const auto& [place, text] : places) {
        const std::size_t found = rest.find(place);
        if (found == std::string_view::npos)
            throw engine::Error("page.html", std::string(place) + " is missing or out of order");
        page.append(rest.substr(0, found)).append(text);
        rest.remove_prefix(found + place.size());
    }
    return page.append(rest);
}

}  // namespace benchmarks
