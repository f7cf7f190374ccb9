#include "benchmarks/viewer/settings/edit_history.h"

#include <utility>

namespace benchmarks {

EditHistory::EditHistory(std::string document) { documents_.push_back(std::move(document)); }

void EditHistory::edit(std::string document, bool continues) {
    const bool replaces = continues && continuing_;
    if (!replaces && document == current()) return;
    continuing_ = continues;
    if (replaces) {
        documents_[index_] = std::move(document);
        return;
    }
    documents_.resize(index_ + 1);
    documents_.push_back(std::move(document));
    ++index_;
}

const std::string& EditHistory::undo() {
    if (canUndo()) --index_;
    continuing_ = false;
    return current();
}

const std::string& EditHistory::redo() {
    if (canRedo()) ++index_;
    continuing_ = false;
    return current();
}

}  // namespace benchmarks
