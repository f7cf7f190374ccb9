#include "benchmarks/run/run_record.h"

#include <algorithm>
#include <iostream>
#include <set>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report_file.h"
#include "benchmarks/run/identity.h"
#include "engine/error.h"

namespace benchmarks {

namespace {

namespace fs = std::filesystem;

bool canHaveJournal(const fs::path& out) {
    std::error_code ignored;
    return !fs::exists(out, ignored) || fs::is_regular_file(out, ignored);
}

Json journalHead(const RunPlan& plan, const ReportHeader& header, const std::string& filter) {
    return {
        {"schema", kJournalSchema},
        {"header", headerJson(header)},
        {"cases_hash", plan.cases_hash},
        {"filter", filter},
        {"planned", plan.cases.size()}};
}

// In what the journal's run is another one than that of `head`; nothing where it is the same.
std::optional<std::string> headDifference(const Json& journal, const Json& head) {
    if (auto difference = identityDifference(journal.at("header"), head.at("header")))
        return difference;
    const auto shard = [](const Json& each) { return each.at("header").value("shard", Json()); };
    if (shard(journal) != shard(head)) return "it is of another --shard";
    if (journal.at("filter") != head.at("filter")) return "it is of another --filter";
    if (journal.at("cases_hash") != head.at("cases_hash")) return "its cases are others";
    return std::nullopt;
}

std::string ofCases(std::size_t done, std::size_t planned) {
    return std::to_string(done) + " of " + std::to_string(planned) + " cases";
}

// The journal's lines to go on with; none where the run begins anew.
std::vector<Json>
linesToKeep(std::vector<Json> lines, const Json& head, bool resume, const std::string& name) {
    if (lines.empty()) return {};
    const auto difference = headDifference(lines.front(), head);
    if (resume) {
        if (difference) throw engine::Error(name, "can't go on: " + *difference);
        return lines;
    }
    if (lines.size() == 1) return {};
    const std::string done = ofCases(lines.size() - 1, lines.front().at("planned"));
    if (!difference)
        throw engine::Error(
            name, "there are " + done +
                      " of a run that was not finished: --resume goes on with it, removing the "
                      "file starts anew");
    std::cerr << name << ": replaces " << done << " of another run: " << *difference << '\n';
    return {};
}

std::set<std::size_t> indicesOf(const std::vector<Json>& cases) {
    std::set<std::size_t> indices;
    for (const Json& each : cases)
        if (each.contains("index")) indices.insert(each.at("index").get<std::size_t>());
    return indices;
}

}  // namespace

fs::path journalFile(const fs::path& report) { return report.string() + ".journal"; }

RunRecord::RunRecord(const RunPlan& plan, const ReportHeader& header, const RecordOptions& options)
    : out_(options.out) {
    if (canHaveJournal(out_))
        journal_ = std::make_unique<Journal>(journalFile(out_));
    else if (options.resume)
        throw engine::Error("--resume", out_.string() + " is no file");
    const std::string name = journalFile(out_).string();
    try {
        Json head = journalHead(plan, header, options.filter);
        std::vector<Json> lines;
        if (journal_) lines = linesToKeep(journal_->read(), head, options.resume, name);
        if (!lines.empty()) {
            head = std::move(lines.front());
            cases_.assign(std::next(lines.begin()), lines.end());
        } else if (journal_) {
            journal_->clear();
            journal_->append(head);
        }
        header_ = std::make_unique<Json>(std::move(head.at("header")));
        const std::set<std::size_t> done = indicesOf(cases_);
        std::size_t order = 0;
        for (const std::size_t place :
             shuffledOrder(plan.cases.size(), header_->at("order_seed").get<std::uint32_t>())) {
            if (!done.contains(plan.cases[place].index)) remaining_.push_back({place, order});
            ++order;
        }
    } catch (const Json::exception& error) {
        throw engine::Error(name, std::string("is no journal of hairbench run: ") + error.what());
    }
}

RunRecord::~RunRecord() = default;

std::size_t RunRecord::done() const { return cases_.size(); }

void RunRecord::add(const CaseResult& result) {
    Json line = caseJson(result);
    try {
        if (journal_) journal_->append(line);
    } catch (const WriteFailed& error) {
        throw WriteFailed(
            std::string(error.what()) + "; " + std::to_string(cases_.size()) +
            (cases_.size() == 1 ? " case is" : " cases are") +
            " kept there: --resume goes on with them");
    }
    cases_.push_back(std::move(line));
}

Json RunRecord::report(bool interrupted) const {
    std::vector<Json> cases = cases_;
    std::ranges::sort(
        cases, {}, [](const Json& each) { return each.at("index").get<std::size_t>(); });
    return assembledReport(*header_, std::move(cases), interrupted);
}

void RunRecord::write(const Json& report) {
    try {
        writeReport(report, out_);
    } catch (const engine::Error& error) {
        if (!journal_) throw;
        throw WriteFailed(
            std::string(error.what()) + "; all is kept in " + journalFile(out_).string() +
            ": --resume writes the report");
    }
    if (journal_ && !report.at("interrupted").get<bool>()) journal_->remove();
}

std::unique_ptr<Json>
completeReport(const RunPlan& plan, const ReportHeader& header, const fs::path& out) {
    std::error_code ignored;
    if (!fs::is_regular_file(out, ignored) || fs::exists(journalFile(out), ignored)) return nullptr;
    auto report = std::make_unique<Json>();
    try {
        *report = readReport(out);
        const Json wanted = headerJson(header);
        if (report->value("interrupted", false) || identityDifference(*report, wanted) ||
            report->value("shard", Json()) != wanted.value("shard", Json()))
            return nullptr;
        std::set<std::pair<std::size_t, std::string>> planned;
        for (const PlannedCase& each : plan.cases) planned.emplace(each.index, each.spec.name);
        std::set<std::pair<std::size_t, std::string>> found;
        for (const Json& each : report->at("cases"))
            found.emplace(each.at("index").get<std::size_t>(), each.at("name").get<std::string>());
        if (planned != found) return nullptr;
    } catch (const Json::exception&) {
        return nullptr;
    } catch (const engine::Error&) {  // another kind of file, or a damaged one
        return nullptr;
    }
    return report;
}

}  // namespace benchmarks
