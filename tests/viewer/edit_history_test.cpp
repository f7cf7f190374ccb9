#include "benchmarks/viewer/settings/edit_history.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace benchmarks {
namespace {

TEST(EditHistory, GoesBackAndForth) {
    EditHistory history{Document("a")};
    EXPECT_FALSE(history.canUndo());
    history.edit(Document("b"), false);
    history.edit(Document("c"), false);
    EXPECT_EQ(history.undo(), Document("b"));
    EXPECT_EQ(history.undo(), Document("a"));
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(history.undo(), Document("a"));
    EXPECT_EQ(history.redo(), Document("b"));
    EXPECT_EQ(history.redo(), Document("c"));
    EXPECT_FALSE(history.canRedo());
}

TEST(EditHistory, TakesADragForOneEdit) {
    EditHistory history{Document("0")};
    for (const char* document : {"1", "2", "3"}) history.edit(Document(document), true);
    history.settle();
    for (const char* document : {"4", "5"}) history.edit(Document(document), true);
    history.edit(Document("6"), false);
    EXPECT_EQ(history.undo(), Document("5"));
    EXPECT_EQ(history.undo(), Document("3"));
    EXPECT_EQ(history.undo(), Document("0"));
}

TEST(EditHistory, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
    EditHistory history{Document("a")};
    history.edit(Document("b"), false);
    history.undo();
    history.edit(Document("c"), false);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), Document("a"));
}

// A click that moved nothing must not swallow the state that a later drag starts from.
TEST(EditHistory, DoesNotContinueAnEditThatChangedNothing) {
    EditHistory history{Document("a")};
    history.edit(Document("a"), true);
    history.edit(Document("b"), true);
    EXPECT_EQ(history.undo(), Document("a"));
}

TEST(EditHistory, KeepsNoEditThatChangesNothing) {
    EditHistory history{Document("a")};
    history.edit(Document("a"), false);
    EXPECT_FALSE(history.canUndo());
}

}  // namespace
}  // namespace benchmarks
