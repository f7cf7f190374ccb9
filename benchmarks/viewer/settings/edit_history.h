#pragma once

#include <vector>

#include "benchmarks/json_text.h"

namespace benchmarks {

// The documents that a scene has been, for undo and redo.
class EditHistory {
public:
    explicit EditHistory(Document document);

    const Document& current() const { return documents_[index_]; }

    // A new state; what was undone is gone. One that `continues` the last, as while a slider is
    // dragged, replaces it.
    void edit(Document document, bool continues);
    // What comes next continues nothing: the slider was let go.
    void settle() { continuing_ = false; }

    bool canUndo() const { return index_ > 0; }
    bool canRedo() const { return index_ + 1 < documents_.size(); }
    const Document& undo();
    const Document& redo();

private:
    std::vector<Document> documents_;
    std::size_t index_ = 0;
    bool continuing_ = false;
};

}  // namespace benchmarks
