#include "benchmarks/viewer/settings/edit_history.h"

#include <utility>

namespace benchmarks {

EditHistory::EditHistory(Document document) { documents_.push_back(std::move(document)); }

void EditHistory::edit(Document document, bool continues) {
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

const Document& EditHistory::undo() {
    if (canUndo()) --index_;
    continuing_ = false;
    return current();
}

const Document& EditHistory::redo() {
    if (canRedo()) ++index_;
    continuing_ = false;
    return current();
}

}  // namespace benchmarks
