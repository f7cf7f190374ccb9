#include "benchmarks/viewer/player.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace benchmarks::viewer {
namespace {

TEST(EditHistory, GoesBackAndForth) {
    EditHistory history{scene::Document("a")};
    EXPECT_FALSE(history.canUndo());
    history.edit(scene::Document("b"), false);
    history.edit(scene::Document("c"), false);
    EXPECT_EQ(history.undo(), scene::Document("b"));
    EXPECT_EQ(history.undo(), scene::Document("a"));
    EXPECT_FALSE(history.canUndo());
    EXPECT_EQ(history.undo(), scene::Document("a"));
    EXPECT_EQ(history.redo(), scene::Document("b"));
    EXPECT_EQ(history.redo(), scene::Document("c"));
    EXPECT_FALSE(history.canRedo());
}

TEST(EditHistory, TakesADragForOneEdit) {
    EditHistory history{scene::Document("0")};
    for (const char* document : {"1", "2", "3"}) history.edit(scene::Document(document), true);
    history.settle();
    for (const char* document : {"4", "5"}) history.edit(scene::Document(document), true);
    history.edit(scene::Document("6"), false);
    EXPECT_EQ(history.undo(), scene::Document("5"));
    EXPECT_EQ(history.undo(), scene::Document("3"));
    EXPECT_EQ(history.undo(), scene::Document("0"));
}

TEST(EditHistory, ForgetsWhatWasUndoneWhenSomethingElseIsDone) {
    EditHistory history{scene::Document("a")};
    history.edit(scene::Document("b"), false);
    history.undo();
    history.edit(scene::Document("c"), false);
    EXPECT_FALSE(history.canRedo());
    EXPECT_EQ(history.undo(), scene::Document("a"));
}

// A click without movement must not replace the state from which a later drag starts.
TEST(EditHistory, DoesNotContinueAnEditThatChangedNothing) {
    EditHistory history{scene::Document("a")};
    history.edit(scene::Document("a"), true);
    history.edit(scene::Document("b"), true);
    EXPECT_EQ(history.undo(), scene::Document("a"));
}

TEST(EditHistory, KeepsNoEditThatChangesNothing) {
    EditHistory history{scene::Document("a")};
    history.edit(scene::Document("a"), false);
    EXPECT_FALSE(history.canUndo());
}

}  // namespace
}  // namespace benchmarks::viewer
