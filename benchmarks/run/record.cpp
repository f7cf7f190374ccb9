#include "benchmarks/run/record.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "benchmarks/report/environment.h"
#include "benchmarks/report/methods.h"
#include "benchmarks/report/report.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"

namespace benchmarks::run {
namespace {

namespace fs = std::filesystem;

// ---- Whether two reports belong together --------------------------------------------------------

struct Member {
    const char* name;
    const char* pointer;
};

constexpr Member kMembers[] = {
    {"hash of the scene", "/scene/hash"},
    {"number of the sweep's cases", "/case_count"},
    {"version", "/environment/build/version"},
    {"commit of the build", "/environment/build/commit"},
    {"type of the build", "/environment/build/type"},
    {"device", "/environment/device/name"},
    {"driver version", "/environment/device/driver_version"},
    {"validation layer", "/environment/validation"},
};
// What a software device runs on.
constexpr Member kProcessor = {"processor", "/environment/host/processor"};

std::string known(std::string text) { return text.empty() ? "unknown" : text; }

}  // namespace

std::optional<std::string> identityDifference(const scene::Json& a, const scene::Json& b) {
    const auto difference = [&](const Member& member) -> std::optional<std::string> {
        const std::string mine = known(scene::textAt(a, member.pointer));
        const std::string other = known(scene::textAt(b, member.pointer));
        if (mine == other) return std::nullopt;
        return std::string(member.name) + ": " + mine + " is not " + other;
    };
    for (const Member& member : kMembers)
        if (auto found = difference(member)) return found;
    if (scene::textAt(a, "/environment/device/type") == "cpu") return difference(kProcessor);
    return std::nullopt;
}

namespace {

// ---- Journal ------------------------------------------------------------------------------------

// Reads and compares like any file, but is not in the folder after a crash unless that is written.
void syncFolderOf(const std::filesystem::path& path) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;  // a folder that may be written but not read
    fsync(file);
    close(file);
}

// Errno's; 0: all is written.
int writeAt(int file, std::string_view text, std::uintmax_t offset) {
    while (!text.empty()) {
        const ssize_t taken = pwrite(file, text.data(), text.size(), static_cast<off_t>(offset));
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0) return errno;
        if (taken == 0) return ENOSPC;
        text.remove_prefix(static_cast<std::size_t>(taken));
        offset += static_cast<std::uintmax_t>(taken);
    }
    return fsync(file) == 0 ? 0 : errno;
}

constexpr std::string_view kBeforeHash = R"({"hash":")";
constexpr std::string_view kBeforeValue = R"(","line":)";
constexpr std::size_t kHashSize = 16;

std::string lineOf(const scene::Json& value) {
    // What drivers and commands say need not be UTF-8.
    const std::string text = value.dump(-1, ' ', false, scene::Json::error_handler_t::replace);
    return std::string(kBeforeHash)
        .append(report::hashText(text))
        .append(kBeforeValue)
        .append(text)
        .append("}\n");
}

// Nothing where the line, without its end, is not as it was written.
std::optional<scene::Json> valueIn(std::string_view line) {
    constexpr std::size_t kStart = kBeforeHash.size() + kHashSize + kBeforeValue.size();
    if (line.size() <= kStart || !line.starts_with(kBeforeHash) || !line.ends_with('}') ||
        line.substr(kBeforeHash.size() + kHashSize, kBeforeValue.size()) != kBeforeValue)
        return std::nullopt;
    const std::string_view text = line.substr(kStart, line.size() - kStart - 1);
    if (line.substr(kBeforeHash.size(), kHashSize) != report::hashText(text)) return std::nullopt;
    try {
        return scene::parseJson(text, "line");  // not too deep, and no member twice
    } catch (const engine::Error&) {
        return std::nullopt;
    }
}

}  // namespace

Journal::Journal(std::filesystem::path path) : path_(std::move(path)) {
    std::error_code error;
    if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) throw engine::Error(path_.string(), std::strerror(errno));
    // Some file systems know no locks: there it goes without.
    if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(file_);
        throw engine::Error(path_.string(), "another run is writing it");
    }
}

Journal::~Journal() {
    if (file_ < 0) return;
    if (lseek(file_, 0, SEEK_END) == 0) unlink(path_.c_str());
    close(file_);
}

std::vector<scene::Json> Journal::read() {
    const std::string text = engine::readFile(path_);
    std::vector<scene::Json> lines;
    damaged_.clear();
    size_ = 0;
    std::size_t number = 1;
    for (std::size_t end; (end = text.find('\n', size_)) != std::string::npos; ++number) {
        auto value = valueIn(std::string_view(text).substr(size_, end - size_));
        if (!value && number == 1)
            throw engine::Error(path_.string(), "is no journal of hairbench run");
        if (value)
            lines.push_back(*std::move(value));
        else
            damaged_.push_back(number);
        size_ = end + 1;
    }
    return lines;
}

void Journal::append(const scene::Json& line) {
    const std::string text = lineOf(line);
    int error = ftruncate(file_, static_cast<off_t>(size_)) == 0 ? 0 : errno;
    if (error == 0) error = writeAt(file_, text, size_);
    if (error != 0) {
        // Should that fail too, the next one who reads leaves the rest out.
        [[maybe_unused]] const int ignored = ftruncate(file_, static_cast<off_t>(size_));
        throw engine::WriteFailed(path_.string() + ": cannot be written: " + std::strerror(error));
    }
    if (size_ == 0) syncFolderOf(path_);
    size_ += text.size();
}

void Journal::clear() { size_ = 0; }

void Journal::remove() {
    unlink(path_.c_str());
    close(std::exchange(file_, -1));
}

namespace {

// ---- Record -------------------------------------------------------------------------------------

bool canHaveJournal(const fs::path& out) {
    std::error_code ignored;
    return !fs::exists(out, ignored) || fs::is_regular_file(out, ignored);
}

scene::Json
journalHead(const RunPlan& plan, const report::ReportHeader& header, const std::string& filter) {
    return {
        {"schema", kJournalSchema},
        {"header", report::headerJson(header)},
        {"cases_hash", plan.cases_hash},
        {"filter", filter},
        {"planned", plan.cases.size()}};
}

// In what the journal's run is another one than that of `head`; nothing where it is the same.
std::optional<std::string> headDifference(const scene::Json& journal, const scene::Json& head) {
    if (auto difference = identityDifference(journal.at("header"), head.at("header")))
        return difference;
    const auto shard = [](const scene::Json& each) {
        return each.at("header").value("shard", scene::Json());
    };
    if (shard(journal) != shard(head)) return "it is of another --shard";
    if (journal.at("filter") != head.at("filter")) return "it is of another --filter";
    if (journal.at("cases_hash") != head.at("cases_hash")) return "its cases are others";
    return std::nullopt;
}

std::string ofCases(std::size_t done, std::size_t planned) {
    return std::to_string(done) + " of " + std::to_string(planned) + " cases";
}

// The journal's lines to go on with; none where the run begins anew.
std::vector<scene::Json> linesToKeep(
    std::vector<scene::Json> lines, const scene::Json& head, bool resume, const std::string& name) {
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

// Whether all that a report says of a case can be made of it.
bool canBeReported(const scene::Json& result) {
    try {
        report::methodsText({{"cases", scene::Json::array({result})}});
        return true;
    } catch (const scene::Json::exception&) {
        return false;
    }
}

// The journal's cases that are the plan's, each once.
std::vector<scene::Json>
casesOf(std::span<scene::Json> lines, const RunPlan& plan, const std::string& name) {
    std::map<std::size_t, std::string> left;
    for (const PlannedCase& each : plan.cases) left.emplace(each.index, each.spec.name);
    const auto is_left = [&](const scene::Json& line) {
        if (!line.is_object() || !line.contains("index") || !line.contains("order")) return false;
        if (!line["index"].is_number_unsigned() || !line["order"].is_number_unsigned())
            return false;
        const auto planned = left.find(line["index"].get<std::size_t>());
        if (planned == left.end() || line.value("name", scene::Json()) != planned->second ||
            !canBeReported(line))
            return false;
        left.erase(planned);
        return true;
    };
    std::vector<scene::Json> cases;
    for (scene::Json& line : lines) {
        if (is_left(line))
            cases.push_back(std::move(line));
        else
            std::cerr << name << ": a line is no case of this run, or there twice: left out\n";
    }
    return cases;
}

std::set<std::size_t> indicesOf(const std::vector<scene::Json>& cases) {
    std::set<std::size_t> indices;
    for (const scene::Json& each : cases) indices.insert(each.at("index").get<std::size_t>());
    return indices;
}

}  // namespace

fs::path journalFile(const fs::path& report) { return report.string() + ".journal"; }

RunRecord::RunRecord(
    const RunPlan& plan, const report::ReportHeader& header, const RecordOptions& options)
    : out_(options.out) {
    if (canHaveJournal(out_))
        journal_ = std::make_unique<Journal>(journalFile(out_));
    else if (options.resume)
        throw engine::Error("--resume", out_.string() + " is no file");
    const std::string name = journalFile(out_).string();
    try {
        scene::Json head = journalHead(plan, header, options.filter);
        std::vector<scene::Json> lines;
        if (journal_) lines = linesToKeep(journal_->read(), head, options.resume, name);
        if (!lines.empty()) {
            head = std::move(lines.front());
            for (const std::size_t line : journal_->damaged())
                std::cerr << name << ": line " << line << " is damaged: left out\n";
            cases_ = casesOf(std::span(lines).subspan(1), plan, name);
        } else if (journal_) {
            journal_->clear();
            journal_->append(head);
        }
        header_ = std::make_unique<scene::Json>(std::move(head.at("header")));
        const std::set<std::size_t> done = indicesOf(cases_);
        std::size_t order = 0;
        for (const std::size_t place :
             shuffledOrder(plan.cases.size(), header_->at("order_seed").get<std::uint32_t>())) {
            if (!done.contains(plan.cases[place].index)) remaining_.push_back({place, order});
            ++order;
        }
    } catch (const scene::Json::exception& error) {
        throw engine::Error(name, std::string("is no journal of hairbench run: ") + error.what());
    }
}

RunRecord::~RunRecord() = default;

std::size_t RunRecord::done() const { return cases_.size(); }

void RunRecord::add(const report::CaseResult& result) {
    scene::Json line = report::caseJson(result);
    try {
        if (journal_) journal_->append(line);
    } catch (const engine::WriteFailed& error) {
        throw engine::WriteFailed(
            std::string(error.what()) + "; " + std::to_string(cases_.size()) +
            (cases_.size() == 1 ? " case is" : " cases are") +
            " kept there: --resume goes on with them");
    }
    cases_.push_back(std::move(line));
}

scene::Json RunRecord::report(bool interrupted) const {
    std::vector<scene::Json> cases = cases_;
    std::ranges::sort(
        cases, {}, [](const scene::Json& each) { return each.at("index").get<std::size_t>(); });
    return report::assembledReport(*header_, std::move(cases), interrupted);
}

void RunRecord::write(const scene::Json& report) {
    try {
        report::writeReport(report, out_);
    } catch (const engine::Error& error) {
        if (!journal_) throw;
        throw engine::WriteFailed(
            std::string(error.what()) + "; all is kept in " + journalFile(out_).string() +
            ": --resume writes the report");
    }
    if (journal_ && !report.at("interrupted").get<bool>()) journal_->remove();
}

std::unique_ptr<scene::Json>
completeReport(const RunPlan& plan, const report::ReportHeader& header, const fs::path& out) {
    std::error_code ignored;
    if (!fs::is_regular_file(out, ignored) || fs::exists(journalFile(out), ignored)) return nullptr;
    auto report = std::make_unique<scene::Json>();
    try {
        *report = report::readReport(out);
        const scene::Json wanted = report::headerJson(header);
        if (report->value("interrupted", false) || identityDifference(*report, wanted) ||
            report->value("shard", scene::Json()) != wanted.value("shard", scene::Json()))
            return nullptr;
        std::set<std::pair<std::size_t, std::string>> planned;
        for (const PlannedCase& each : plan.cases) planned.emplace(each.index, each.spec.name);
        std::set<std::pair<std::size_t, std::string>> found;
        for (const scene::Json& each : report->at("cases"))
            found.emplace(each.at("index").get<std::size_t>(), each.at("name").get<std::string>());
        if (planned != found) return nullptr;
    } catch (const scene::Json::exception&) {
        return nullptr;
    } catch (const engine::Error&) {  // another kind of file, or a damaged one
        return nullptr;
    }
    return report;
}

}  // namespace benchmarks::run
