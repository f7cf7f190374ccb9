#include "benchmarks/viewer/settings/edit_history.h"

#include <gtest/gtest.h>

namespace benchmarks {
namespace {

TEST(EditHistory, GoesBackAndForth) {
    EditHistory history("a");
    EXPECT_FALSE(history.canUndo());
    history.edit("b", false);
    history.edit("c", false);
    EXPECT_EQ(history.undo(), "b");
    EXPECT_EQ(history.undo(), "a");
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(history.undo(), "a");
    EXPECT_EQ(history.redo(), "b");
    EXPECT_EQ(history.redo(), "c");
    EXPECT_FALSE(history.canRedo());
}

TEST(EditHistory, TakesADragForOneEdit) {
    EditHistory history("0");
    for (const char* document : {"1", "2", "3"}) history.edit(document, true);
    history.settle();
    for (const char* document : {"4", "5"}) history.edit(document, true);
    history.edit("6", false);
    EXPECT_EQ(history.undo(), "5");
    EXPECT_EQ(history.undo(), "3");
    EXPECT_EQ(history.undo(), "0");
}

TEST(EditHistory, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
    EditHistory history("a");
    history.edit("b", false);
    history.undo();
    history.edit("c", false);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), "a");
}

// A click that moved nothing must not swallow the state that a later drag starts from.
TEST(EditHistory, DoesNotContinueAnEditThatChangedNothing) {
    EditHistory history("a");
    history.edit("a", true);
    history.edit("b", true);
    EXPECT_EQ(history.undo(), "a");
}

TEST(EditHistory, KeepsNoEditThatChangesNothing) {
    EditHistory history("a");
    history.edit("a", false);
    EXPECT_FALSE(history.canUndo());
}

}  // namespace
}  // namespace benchmarks
