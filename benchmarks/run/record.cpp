#include "benchmarks/run/record.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "benchmarks/report/environment.h"
#include "benchmarks/report/methods.h"
#include "benchmarks/report/report.h"
#include "benchmarks/report/verdict.h"
#include "benchmarks/scene/json.h"
#include "engine/error.h"
#include "engine/files.h"
#include "engine/instance.h"

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
// A software device runs on this processor.
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
    const std::string type = scene::textAt(a, "/environment/device/type");
    if (type == engine::deviceTypeName(engine::DeviceType::cpu)) return difference(kProcessor);
    return std::nullopt;
}

namespace {

// ---- Journal ------------------------------------------------------------------------------------

constexpr std::size_t kPiece = std::size_t{1} << 20;  // B per read
// B, far more than a case needs: a file without line breaks is not a journal.
constexpr std::size_t kLongestLine = std::size_t{1} << 28;

constexpr std::string_view kBeforeHash = R"({"hash":")";
constexpr std::string_view kBeforeValue = R"(","line":)";
constexpr std::size_t kHashSize = 16;

std::string reasonOf(int error) { return std::generic_category().message(error); }

std::string lineOf(const scene::Json& value) {
    // Texts from drivers and the command line need not be UTF-8.
    const std::string text = value.dump(-1, ' ', false, scene::Json::error_handler_t::replace);
    return std::string(kBeforeHash)
        .append(report::hashText(text))
        .append(kBeforeValue)
        .append(text)
        .append("}\n");
}

// Returns nothing if the line, without its line break, is damaged.
std::optional<scene::Json> valueIn(std::string_view line) {
    constexpr std::size_t kStart = kBeforeHash.size() + kHashSize + kBeforeValue.size();
    if (line.size() <= kStart || !line.starts_with(kBeforeHash) || !line.ends_with('}') ||
        line.substr(kBeforeHash.size() + kHashSize, kBeforeValue.size()) != kBeforeValue)
        return std::nullopt;
    const std::string_view text = line.substr(kStart, line.size() - kStart - 1);
    if (line.substr(kBeforeHash.size(), kHashSize) != report::hashText(text)) return std::nullopt;
    try {
        return scene::parseJson(text, "line");  // rejects deep nesting and duplicate members
    } catch (const engine::Error&) {
        return std::nullopt;
    }
}

}  // namespace

Journal::Journal(std::filesystem::path path, Lasts lasts) : path_(std::move(path)), lasts_(lasts) {
    std::error_code error;
    if (path_.has_parent_path()) std::filesystem::create_directories(path_.parent_path(), error);
    engine::system::Locked locked = engine::system::openLocked(path_);
    using enum engine::system::Lock;
    switch (locked.lock) {
    case held:
        break;
    case by_another:
        throw engine::Error(path_.string(), "another run is writing it");
    case is_link:
        throw engine::Error(path_.string(), "is a link, but the journal must be written there");
    case is_no_file:
        throw engine::Error(path_.string(), "is not a file, but the journal must be written there");
    case failed:
        throw engine::Error(path_.string(), reasonOf(locked.opened.error));
    }
    file_ = std::move(locked.opened.file);
}

Journal::~Journal() {
    if (file_.isOpen() && file_.size() == 0) remove();
}

void Journal::read(const std::function<void(scene::Json value, const Place& place)>& visit) {
    damaged_.clear();
    size_ = 0;
    ends_there_ = false;
    std::size_t number = 1;
    const auto take = [&](std::string_view line) {
        auto value = valueIn(line);
        if (!value && number == 1)
            throw engine::Error(path_.string(), "is not a journal of 'hairbench run'");
        if (value)
            visit(*std::move(value), {.begin = size_, .size = line.size()});
        else
            damaged_.push_back(number);
        size_ += line.size() + 1;
        ++number;
    };
    std::string text;  // read after the last whole line
    std::vector<char> piece(kPiece);
    while (true) {
        const std::size_t taken = file_.readAt(piece, size_ + text.size());
        if (taken == 0) return;
        const std::size_t known = text.size();  // contains no line break
        text.append(piece.data(), taken);
        std::size_t begin = 0;
        for (std::size_t end = text.find('\n', known); end != std::string::npos;
             end = text.find('\n', begin)) {
            take(std::string_view(text).substr(begin, end - begin));
            begin = end + 1;
        }
        text.erase(0, begin);
        if (text.size() > kLongestLine)
            throw engine::Error(path_.string(), "is not a journal of 'hairbench run'");
    }
}

scene::Json Journal::at(const Place& place) const {
    std::string line(place.size, '\0');
    const bool is_there = file_.readAt(line, place.begin) == line.size();
    auto value = is_there ? valueIn(line) : std::nullopt;
    if (!value) throw engine::Error(path_.string(), "was changed during the run");
    return *std::move(value);
}

Journal::Place Journal::append(const scene::Json& line) {
    const std::string text = lineOf(line);
    int error = std::exchange(ends_there_, false) ? 0 : file_.cut(size_);
    if (error == 0) error = file_.writeAt(text, size_);
    if (error == 0 && lasts_ == Lasts::crash) error = file_.sync();
    if (error != 0) {
        file_.cut(size_);  // if this fails too, the next reader skips the rest
        throw engine::WriteFailed(path_.string() + ": cannot be written: " + reasonOf(error));
    }
    // Without that, a new file may be missing from its folder after a crash.
    if (size_ == 0 && lasts_ == Lasts::crash)
        engine::system::syncFolder(path_.has_parent_path() ? path_.parent_path() : ".");
    const Place place{.begin = size_, .size = text.size() - 1};
    size_ += text.size();
    ends_there_ = true;
    return place;
}

void Journal::clear() {
    size_ = 0;
    ends_there_ = false;
}

void Journal::remove() { engine::system::removeOpen(std::move(file_), path_); }

namespace {

// ---- Record -------------------------------------------------------------------------------------

scene::Json
journalHead(const RunPlan& plan, const report::ReportHeader& header, const std::string& filter) {
    return {
        {"schema", kJournalSchema},
        {"header", report::headerJson(header)},
        {"cases_hash", plan.cases_hash},
        {"filter", filter},
        {"planned", plan.cases.size()}};
}

// Returns the difference between the journal's run and that of `head`; nothing if it is the same
// run.
std::optional<std::string> headDifference(const scene::Json& journal, const scene::Json& head) {
    if (auto difference = identityDifference(journal.at("header"), head.at("header")))
        return difference;
    const auto shard = [](const scene::Json& each) {
        return each.at("header").value("shard", scene::Json());
    };
    if (shard(journal) != shard(head)) return "its --shard differs";
    if (journal.at("filter") != head.at("filter")) return "its --filter differs";
    if (journal.at("cases_hash") != head.at("cases_hash")) return "its cases differ";
    return std::nullopt;
}

std::string ofCases(std::size_t done, std::size_t planned) {
    return std::to_string(done) + " of " + std::to_string(planned) + " cases";
}

// Whether to continue with a journal that has `cases` cases. Throws if it can neither be continued
// nor replaced.
bool goesOn(
    const scene::Json& journal, std::size_t cases, const scene::Json& head, bool resume,
    const std::string& name) {
    const auto difference = headDifference(journal, head);
    if (resume) {
        if (difference) throw engine::Error(name, "can't be resumed: " + *difference);
        return true;
    }
    if (cases == 0) return false;
    const std::string done = ofCases(cases, journal.at("planned"));
    if (!difference)
        throw engine::Error(
            name, "there are " + done +
                      " of a run that was not finished: --resume continues it; remove the file to "
                      "start anew");
    std::cerr << engine::shownText(name + ": replaces " + done + " of another run: " + *difference)
              << '\n';
    return false;
}

// Whether a report can be written from the case's JSON.
bool canBeReported(const scene::Json& result) {
    try {
        report::methodsText({{"cases", scene::Json::array({result})}});
        return true;
    } catch (const scene::Json::exception&) {
        return false;
    }
}

// The cases of a plan that no line of the journal covers yet.
class CasesLeft {
public:
    explicit CasesLeft(const RunPlan& plan) {
        for (const PlannedCase& each : plan.cases) left_.emplace(each.index, &each.spec.name);
    }

    // Returns the case's index in the sweep; nothing if the line is not a case of the plan, or
    // repeats one.
    std::optional<std::size_t> take(const scene::Json& line) {
        if (!line.is_object() || !line.contains("index") || !line.contains("order")) return {};
        if (!line["index"].is_number_unsigned() || !line["order"].is_number_unsigned()) return {};
        const auto index = line["index"].get<std::size_t>();
        const auto planned = left_.find(index);
        if (planned == left_.end() || line.value("name", scene::Json()) != *planned->second ||
            !canBeReported(line))
            return {};
        left_.erase(planned);
        return index;
    }
    bool has(std::size_t index) const { return left_.contains(index); }

private:
    std::map<std::size_t, const std::string*> left_;
};

}  // namespace

fs::path journalFile(const fs::path& report) { return report.string() + ".journal"; }

RunRecord::RunRecord(
    const RunPlan& plan, const report::ReportHeader& header, const RecordOptions& options)
    : out_(options.out) {
    if (!engine::isReplaceable(out_)) {
        if (options.resume) throw engine::Error("--resume", out_.string() + " is not a file");
        std::cerr << "hairbench: " << engine::shownText(out_.string())
                  << " is not a file: this run has no journal, and can't be resumed\n";
        scratch_ = std::make_unique<engine::ScratchFolder>();
    }
    const fs::path file = scratch_ ? scratch_->path() / "journal" : journalFile(out_);
    journal_ =
        std::make_unique<Journal>(file, scratch_ ? Journal::Lasts::process : Journal::Lasts::crash);
    const std::string name = file.string();
    try {
        scene::Json head = journalHead(plan, header, options.filter);
        std::optional<scene::Json> found;
        std::size_t cases = 0, strays = 0;
        CasesLeft left(plan);
        journal_->read([&](scene::Json line, const Journal::Place& place) {
            if (!found) {
                found = std::move(line);
                return;
            }
            ++cases;
            if (const auto index = left.take(line))
                keep(*index, line, place);
            else
                ++strays;
        });
        if (found && goesOn(*found, cases, head, options.resume, name)) {
            head = *std::move(found);
            for (const std::size_t line : journal_->damaged())
                std::cerr << engine::shownText(name) << ": line " << line
                          << " is damaged and left out\n";
            for (; strays > 0; --strays)
                std::cerr
                    << engine::shownText(name)
                    << ": a line is not a case of this run, or repeats one, and is left out\n";
        } else {
            left = CasesLeft(plan);
            done_.clear();
            measured_ = 0;
            large_samples_ = report::LargeSamples::none;
            journal_->clear();
            journal_->append(head);
        }
        header_ = std::make_unique<scene::Json>(std::move(head.at("header")));
        std::size_t order = 0;
        for (const std::size_t place :
             shuffledOrder(plan.cases.size(), header_->at("order_seed").get<std::uint32_t>())) {
            if (left.has(plan.cases[place].index)) remaining_.push_back({place, order});
            ++order;
        }
    } catch (const scene::Json::exception& error) {
        throw engine::Error(
            name, "is not a journal of 'hairbench run': " + scene::jsonReason(error));
    }
}

RunRecord::~RunRecord() = default;

void RunRecord::keep(std::size_t index, const scene::Json& result, const Journal::Place& line) {
    done_.push_back({.index = index, .line = line});
    measured_ += result.value("status", "") == report::statusName(report::Status::ok);
    if (report::hasLargeSamples(result)) large_samples_ = report::LargeSamples::some;
}

void RunRecord::add(const report::CaseResult& result) {
    scene::Json line = report::caseJson(result);
    report::putVerdict(header_->at("environment"), line);
    try {
        keep(result.index.value(), line, journal_->append(line));
    } catch (const engine::WriteFailed& error) {
        if (!hasJournal()) throw;
        throw engine::WriteFailed(
            std::string(error.what()) + "; " + std::to_string(done_.size()) +
            (done_.size() == 1 ? " case is" : " cases are") +
            " kept there: --resume continues with them");
    }
}

void RunRecord::eachCase(const std::function<void(scene::Json)>& visit) const {
    std::vector<Done> cases = done_;
    std::ranges::sort(cases, {}, &Done::index);
    for (const Done& each : cases) visit(journal_->at(each.line));
}

void RunRecord::write(RunEnd end, const std::function<void(const scene::Json&)>& visit) {
    scene::Json header = *header_;
    header["interrupted"] = end == RunEnd::interrupted;
    try {
        const report::EachCase cases = [&](const auto& take) {
            eachCase([&](scene::Json each) {
                if (visit) visit(each);
                take(std::move(each));
            });
        };
        report::writeReport(header, cases, large_samples_, out_);
    } catch (const engine::Error& error) {
        if (!hasJournal()) throw;
        throw engine::WriteFailed(
            std::string(error.what()) + "; all is kept in " + journalFile(out_).string() +
            ": --resume writes the report");
    }
    if (end == RunEnd::complete) {
        journal_->remove();
        done_.clear();
    }
}

std::optional<std::size_t>
measuredInComplete(const RunPlan& plan, const report::ReportHeader& header, const fs::path& out) {
    std::error_code ignored;
    if (!fs::is_regular_file(out, ignored) || fs::exists(journalFile(out), ignored)) return {};
    std::size_t measured = 0;
    try {
        const scene::Json report = report::readReport(out);
        const scene::Json wanted = report::headerJson(header);
        if (report.value("interrupted", false) || identityDifference(report, wanted) ||
            report.value("shard", scene::Json()) != wanted.value("shard", scene::Json()))
            return {};
        std::set<std::pair<std::size_t, std::string>> planned;
        for (const PlannedCase& each : plan.cases) planned.emplace(each.index, each.spec.name);
        std::set<std::pair<std::size_t, std::string>> found;
        for (const scene::Json& each : report.at("cases")) {
            found.emplace(each.at("index").get<std::size_t>(), each.at("name").get<std::string>());
            measured += each.at("status") == report::statusName(report::Status::ok);
        }
        if (planned != found) return {};
    } catch (const scene::Json::exception&) {
        return {};
    } catch (const engine::Error&) {  // another kind of file, or a damaged one
        return {};
    }
    return measured;
}

// ---- Sweeps whose results are files -------------------------------------------------------------

namespace {

constexpr const char* kSweepSchema = "hairbench-sweep-journal/1.0.0";

std::string settingsHash(const scene::CaseSpec& spec) {
    return report::hashText(documentOf(spec).text());
}

}  // namespace

SweepRecord::SweepRecord(fs::path journal, scene::Json identity, bool resume)
    : journal_(std::make_unique<Journal>(journal)),
      finished_(std::make_unique<scene::Json>(scene::Json::object())) {
    identity["schema"] = kSweepSchema;
    identity["version"] = report::versionText();
    scene::Json head;
    if (resume)
        journal_->read([&](scene::Json line, const Journal::Place&) {
            if (head.is_null()) {
                head = std::move(line);
            } else if (line.contains("name")) {
                const auto name = line["name"].get<std::string>();
                (*finished_)[name] = std::move(line);
            }
        });
    if (head.is_null()) {
        journal_->clear();
        journal_->append(identity);
        return;
    }
    for (const auto& [member, value] : identity.items()) {
        const scene::Json other = head.value(member, scene::Json());
        if (other != value)
            throw engine::Error(
                journal.string(), "can't be resumed: its " + member + " is " + other.dump() +
                                      ", not " + value.dump());
    }
}

SweepRecord::~SweepRecord() = default;

scene::Json SweepRecord::finished(const scene::CaseSpec& spec) const {
    const auto found = finished_->find(spec.name);
    if (found == finished_->end() || found->at("settings") != settingsHash(spec)) return nullptr;
    return found->at("written");
}

void SweepRecord::add(const scene::CaseSpec& spec, const scene::Json& written) {
    journal_->append({{"name", spec.name}, {"settings", settingsHash(spec)}, {"written", written}});
}

void SweepRecord::complete() { journal_->remove(); }

}  // namespace benchmarks::run
