#include "benchmarks/viewer/side.h"

#include <string>

#include <gtest/gtest.h>

namespace benchmarks::viewer {
namespace {

hair::Settings described(const std::string& description) { return {.description = description}; }

TEST(EditHistory, GoesBackAndForth) {
    EditHistory history{described("a")};
    EXPECT_FALSE(history.canUndo());
    history.edit(described("b"), false);
    history.edit(described("c"), false);
    EXPECT_EQ(history.undo().description, "b");
    EXPECT_EQ(history.undo().description, "a");
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(history.undo().description, "a");
    EXPECT_EQ(history.redo().description, "b");
    EXPECT_EQ(history.redo().description, "c");
    EXPECT_FALSE(history.canRedo());
}

TEST(EditHistory, TakesADragForOneEdit) {
    EditHistory history{described("0")};
    for (const char* text : {"1", "2", "3"}) history.edit(described(text), true);
    history.settle();
    for (const char* text : {"4", "5"}) history.edit(described(text), true);
    history.edit(described("6"), false);
    EXPECT_EQ(history.undo().description, "5");
    EXPECT_EQ(history.undo().description, "3");
    EXPECT_EQ(history.undo().description, "0");
}

TEST(EditHistory, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
    EditHistory history{described("a")};
    history.edit(described("b"), false);
    history.undo();
    history.edit(described("c"), false);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo().description, "a");
}

// A click without movement must not replace the state from which a later drag starts.
TEST(EditHistory, DoesNotContinueAnEditThatChangedNothing) {
    EditHistory history{described("a")};
    history.edit(described("a"), true);
    history.edit(described("b"), true);
    EXPECT_EQ(history.undo().description, "a");
}

TEST(EditHistory, KeepsNoEditThatChangesNothing) {
    EditHistory history{described("a")};
    history.edit(described("a"), false);
    EXPECT_FALSE(history.canUndo());
}

}  // namespace
}  // namespace benchmarks::viewer
