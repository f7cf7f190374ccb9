#include "benchmarks/compare/mismatch.h"

#include <nlohmann/json.hpp>

namespace benchmarks {

namespace {

std::string statusText(const CaseOutcome& outcome) {
    return outcome.reason.empty() ? outcome.status : outcome.status + ": " + outcome.reason;
}

bool differ(const std::string& a, const std::string& b) {
    return !a.empty() && !b.empty() && a != b;
}

}  // namespace

CaseOutcome caseOutcome(const Json& result) {
    return {
        .name = result.at("name").get<std::string>(),
        .status = result.at("status").get<std::string>(),
        .reason = result.value("reason", ""),
        .image_hash = result.value("image_hash", ""),
        .state_hash = result.value("state_hash", "")};
}

std::vector<Mismatch> mismatches(const CaseOutcome& a, const CaseOutcome& b) {
    const bool a_ok = a.status == "ok";
    const bool b_ok = b.status == "ok";
    if (!a_ok && !b_ok) return {};
    if (a_ok != b_ok) return {{a.name, "status", statusText(a), statusText(b)}};
    std::vector<Mismatch> found;
    if (differ(a.image_hash, b.image_hash))
        found.push_back({a.name, "picture", a.image_hash, b.image_hash});
    if (differ(a.state_hash, b.state_hash))
        found.push_back({a.name, "state", a.state_hash, b.state_hash});
    return found;
}

std::string mismatchText(const Mismatch& mismatch) {
    const std::string plural = mismatch.what == "status" ? "outcomes" : mismatch.what + 's';
    return mismatch.case_name + ": the " + plural + " differ: " + mismatch.a + " and " + mismatch.b;
}

Json mismatchJson(const Mismatch& mismatch) {
    return {
        {"case", mismatch.case_name},
        {"what", mismatch.what},
        {"a", mismatch.a},
        {"b", mismatch.b}};
}

}  // namespace benchmarks
