#include "benchmarks/viewer/side.h"

#include <utility>

#include "benchmarks/scene/extensions.h"
#include "hair/fields.h"

namespace benchmarks::viewer {

// ---- Edit history -------------------------------------------------------------------------------

EditHistory::EditHistory(const hair::Settings& settings) : states_{settings} {}

void EditHistory::edit(const hair::Settings& settings, bool continues) {
    const bool replaces = continues && continuing_;
    if (!replaces && !hair::differ(settings, current())) return;
    continuing_ = continues;
    if (replaces) {
        states_[index_] = settings;
        return;
    }
    states_.resize(++index_);
    states_.push_back(settings);
}

const hair::Settings& EditHistory::undo() {
    if (canUndo()) --index_;
    continuing_ = false;
    return current();
}

const hair::Settings& EditHistory::redo() {
    if (canRedo()) ++index_;
    continuing_ = false;
    return current();
}

// ---- Side ---------------------------------------------------------------------------------------

Side::Side(std::uint64_t id, const hair::Settings& settings, const std::filesystem::path& directory)
    : id_(id), directory_(directory), wanted_(settings), original_(settings), history_(settings) {
    shown_.settings = settings;
    shown_.directory = directory;
}

void Side::edit(const hair::Settings& settings, Edit edit) {
    if (!edit.changed) return;
    wanted_ = settings;
    scene::rereadExtensions(wanted_, directory_);
    history_.edit(wanted_, edit.continues);
    continues_ = edit.continues;
    ++revision_;
}

void Side::settle() {
    history_.settle();
    if (!continues_) return;
    continues_ = false;
    ++revision_;
}

void Side::undo() {
    wanted_ = history_.undo();
    scene::rereadExtensions(wanted_, directory_);
    continues_ = false;
    ++revision_;
}

void Side::redo() {
    wanted_ = history_.redo();
    scene::rereadExtensions(wanted_, directory_);
    continues_ = false;
    ++revision_;
}

SideOrder Side::order() const {
    return {
        .side = id_,
        .revision = revision_,
        .settings = wanted_,
        .continues = continues_,
        .directory = directory_};
}

void Side::take(SideReply reply, Beside beside) {
    answered_ = reply.revision;
    problem_ = std::move(reply.problem);
    if (reply.reread) scene::rereadExtensions(wanted_, directory_);
    if (reply.restarts_timings) timings_.clear();
    if (reply.timed && beside == Beside::nothing)
        timings_.add(reply.timed->record, reply.timed->timing, reply.timed->number);
    if (reply.shown) shown_ = std::move(*reply.shown);
}

}  // namespace benchmarks::viewer
