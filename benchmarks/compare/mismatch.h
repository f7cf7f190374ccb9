#pragma once

#include <string>
#include <vector>

#include "benchmarks/json_fwd.h"

namespace benchmarks {

// What a case made, as its report says.
struct CaseOutcome {
    std::string name;
    std::string status;  // "ok", "skipped", "failed"
    std::string reason;  // why it was not ok
    std::string image_hash;  // may be empty: not known
    std::string state_hash;
};

// Something of a case that differs between two reports, so that their times say nothing.
struct Mismatch {
    std::string case_name;
    std::string what;  // "picture", "state", or "status" where only one played it
    std::string a;  // hashes, or "failed: reason"
    std::string b;
};

// Of a case's object in a report.
CaseOutcome caseOutcome(const Json& result);

// Hashes that either report does not know agree. Of a case that neither played nothing differs.
std::vector<Mismatch> mismatches(const CaseOutcome& a, const CaseOutcome& b);

// "thesis/msaa:4: the pictures differ: 0123456789abcdef and fedcba9876543210"
std::string mismatchText(const Mismatch& mismatch);

// {"case", "what", "a", "b"}
Json mismatchJson(const Mismatch& mismatch);

}  // namespace benchmarks
