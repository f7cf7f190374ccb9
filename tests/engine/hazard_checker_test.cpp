#include "engine/hazards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/commands.h"
#include "engine/frame_loop.h"
#include "engine/transfer.h"
#include "tests/gpu_fixture.h"

// Expected results: synchronization chapter of the Vulkan specification, 7.1 to 7.6.
namespace engine {
namespace {

using Kind = Hazard::Kind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Scope kComputeRead{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT};
constexpr Scope kComputeWrite{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
constexpr Scope kVertexRead{VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT};
constexpr Scope kTaskRead{VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT, VK_ACCESS_2_SHADER_READ_BIT};
constexpr Scope kMeshRead{VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT, VK_ACCESS_2_SHADER_READ_BIT};
constexpr Scope kFragmentRead{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_READ_BIT};
constexpr Scope kCopyRead{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr Scope kFill{VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Scope kTransferWrite{
    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr Scope kColorWrite{
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

Scope executionOnly(Scope scope) { return {scope.stages, 0}; }

Recorded use(ResourceId resource, Scope scope, const char* pass = "") {
    return {.pass = pass, .uses = {{resource, scope}}, .barriers = {}};
}

Recorded barrier(Scope before, Scope after, const char* place = "") {
    return {
        .pass = {}, .uses = {}, .barriers = {{.before = before, .after = after, .place = place}}};
}

Recorded imageBarrier(ResourceId image, Scope before, Scope after, bool transitions_layout) {
    Recorded recorded = barrier(before, after);
    recorded.barriers[0].image = image;
    recorded.barriers[0].transitions_layout = transitions_layout;
    return recorded;
}

std::vector<Kind> hazards(const Recording& recording) {
    std::vector<Kind> kinds;
    for (const Hazard& hazard : HazardChecker().submit(recording)) kinds.push_back(hazard.kind);
    return kinds;
}

TEST(HazardChecker, WantsABarrierBetweenAWriteAndARead) {
    EXPECT_THAT(
        hazards({use(1, kComputeWrite), use(1, kVertexRead)}), ElementsAre(Kind::read_after_write));
    EXPECT_THAT(
        hazards({use(1, kComputeWrite), barrier(kComputeWrite, kVertexRead), use(1, kVertexRead)}),
        IsEmpty());
    EXPECT_THAT(hazards({use(1, kComputeWrite), use(2, kVertexRead)}), IsEmpty());
    EXPECT_THAT(hazards({use(1, kComputeRead), use(1, kVertexRead)}), IsEmpty());
}

TEST(HazardChecker, NamesTheResourceAndThePasses) {
    const std::vector<Hazard> found =
        HazardChecker().submit({use(7, kComputeWrite, "wind"), use(7, kComputeRead, "simulate")});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].resource, 7u);
    EXPECT_EQ(found[0].earlier, "wind");
    EXPECT_EQ(found[0].later, "simulate");
}

// A memory dependency makes a write available by its own stage and access, and visible to the
// stages and accesses that the barrier names.
TEST(HazardChecker, HoldsStagesAndAccessesAgainstTheBarriers) {
    const auto between = [](Scope before, Scope after) {
        return hazards({use(1, kComputeWrite), barrier(before, after), use(1, kVertexRead)});
    };
    const auto kHazard = ElementsAre(Kind::read_after_write);
    EXPECT_THAT(between(kComputeRead, kVertexRead), kHazard);  // not made available
    EXPECT_THAT(between(kTransferWrite, kVertexRead), kHazard);  // another source stage
    EXPECT_THAT(between(kComputeWrite, kFragmentRead), kHazard);  // another destination stage
    EXPECT_THAT(between(kComputeWrite, executionOnly(kVertexRead)), kHazard);
    EXPECT_THAT(
        between(
            {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT},
            {VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, VK_ACCESS_2_MEMORY_READ_BIT}),
        IsEmpty());
    EXPECT_THAT(
        between(
            kComputeWrite,
            {VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, VK_ACCESS_2_SHADER_READ_BIT}),
        IsEmpty());
}

TEST(HazardChecker, WantsOnlyOrderBetweenAReadAndAWrite) {
    EXPECT_THAT(
        hazards({use(1, kCopyRead), use(1, kComputeWrite)}), ElementsAre(Kind::write_after_read));
    EXPECT_THAT(
        hazards(
            {use(1, kCopyRead), barrier(executionOnly(kCopyRead), executionOnly(kComputeWrite)),
             use(1, kComputeWrite)}),
        IsEmpty());
    EXPECT_THAT(
        hazards(
            {use(1, kCopyRead), barrier(executionOnly(kComputeRead), executionOnly(kComputeWrite)),
             use(1, kComputeWrite)}),
        ElementsAre(Kind::write_after_read));
}

TEST(HazardChecker, WantsEveryReadBeforeAWriteToBeWaitedFor) {
    EXPECT_THAT(
        hazards(
            {use(1, kVertexRead), use(1, kComputeRead), barrier(kComputeRead, kFill),
             use(1, kFill)}),
        ElementsAre(Kind::write_after_read));
}

TEST(HazardChecker, WantsMemoryDependenciesBetweenWrites) {
    EXPECT_THAT(hazards({use(1, kFill), use(1, kFill)}), ElementsAre(Kind::write_after_write));
    EXPECT_THAT(
        hazards(
            {use(1, kFill), barrier(executionOnly(kFill), executionOnly(kFill)), use(1, kFill)}),
        ElementsAre(Kind::write_after_write));
    EXPECT_THAT(
        hazards({use(1, kFill), barrier(kTransferWrite, kTransferWrite), use(1, kFill)}),
        IsEmpty());
}

// Available memory stays available. A second barrier makes it visible to others if it chains to the
// first by a stage in the first one's destination.
TEST(HazardChecker, FollowsChainsOfBarriers) {
    const auto chained = [](Scope middle_after, Scope middle_before) {
        return hazards(
            {use(1, kComputeWrite), barrier(kComputeWrite, middle_after),
             barrier(middle_before, kVertexRead), use(1, kVertexRead)});
    };
    EXPECT_THAT(chained(kFill, executionOnly(kFill)), IsEmpty());
    EXPECT_THAT(chained(kFragmentRead, executionOnly(kFill)), ElementsAre(Kind::read_after_write));
}

// All dependencies of one command start from the commands recorded before it.
TEST(HazardChecker, ChainsNoBarriersOfOneCommand) {
    Recorded both = barrier(kComputeWrite, kVertexRead);
    both.barriers.push_back(barrier(executionOnly(kVertexRead), kFragmentRead).barriers[0]);
    EXPECT_THAT(hazards({use(1, kComputeWrite), both, use(1, kVertexRead)}), IsEmpty());
    EXPECT_THAT(
        hazards({use(1, kComputeWrite), both, use(1, kFragmentRead)}),
        ElementsAre(Kind::read_after_write));
}

// A barrier waits for the named stage and earlier stages of a draw, and delays the named stage and
// later ones. But memory becomes visible only to the named stages.
TEST(HazardChecker, KnowsTheOrderOfADrawsStages) {
    const auto read = [](Scope reads, Scope waited_for) {
        return hazards({use(1, reads), barrier(waited_for, kComputeWrite), use(1, kComputeWrite)});
    };
    EXPECT_THAT(read(kVertexRead, kFragmentRead), IsEmpty());
    EXPECT_THAT(read(kFragmentRead, kVertexRead), ElementsAre(Kind::write_after_read));
    const Recording holds_up_later{
        use(1, kComputeRead), barrier(kComputeRead, kVertexRead), use(1, kColorWrite)};
    EXPECT_THAT(hazards(holds_up_later), IsEmpty());
    const Recording sees_later{
        use(1, kComputeWrite), barrier(kComputeWrite, kVertexRead), use(1, kFragmentRead)};
    EXPECT_THAT(hazards(sees_later), ElementsAre(Kind::read_after_write));
}

// The stages of a mesh draw are not part of a vertex draw.
TEST(HazardChecker, KnowsTheOrderOfTheStagesOfMeshes) {
    const auto read = [](Scope reads, Scope waited_for) {
        return hazards({use(1, reads), barrier(waited_for, kComputeWrite), use(1, kComputeWrite)});
    };
    const auto kHazard = ElementsAre(Kind::write_after_read);
    EXPECT_THAT(read(kTaskRead, kMeshRead), IsEmpty());
    EXPECT_THAT(read(kMeshRead, kFragmentRead), IsEmpty());
    EXPECT_THAT(read(kMeshRead, kTaskRead), kHazard);
    EXPECT_THAT(read(kFragmentRead, kMeshRead), kHazard);
    EXPECT_THAT(read(kVertexRead, kMeshRead), kHazard);
    EXPECT_THAT(read(kMeshRead, kVertexRead), kHazard);
    const Scope before_raster{
        VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, VK_ACCESS_2_SHADER_READ_BIT};
    const Scope all{VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, VK_ACCESS_2_SHADER_READ_BIT};
    for (const Scope& group : {before_raster, all}) {
        EXPECT_THAT(read(kTaskRead, group), IsEmpty());
        EXPECT_THAT(
            hazards(
                {use(1, kComputeWrite), barrier(kComputeWrite, group), use(1, kTaskRead),
                 use(1, kMeshRead)}),
            IsEmpty());
    }
}

TEST(HazardChecker, LetsAnImagesBarrierOrderAllAndShowItselfAlone) {
    const Recorded image_barrier = imageBarrier(1, kComputeWrite, kVertexRead, false);
    EXPECT_THAT(hazards({use(1, kComputeWrite), image_barrier, use(1, kVertexRead)}), IsEmpty());
    EXPECT_THAT(
        hazards({use(2, kComputeWrite), image_barrier, use(2, kVertexRead)}),
        ElementsAre(Kind::read_after_write));
    EXPECT_THAT(
        hazards({use(2, kComputeRead), imageBarrier(1, kComputeRead, kFill, false), use(2, kFill)}),
        IsEmpty());
}

TEST(HazardChecker, TakesAChangeOfLayoutForAWrite) {
    const Recorded change = imageBarrier(1, kFragmentRead, kColorWrite, true);
    EXPECT_THAT(hazards({use(1, kFragmentRead), change, use(1, kColorWrite)}), IsEmpty());
    EXPECT_THAT(
        hazards({use(1, kComputeRead), change, use(1, kColorWrite)}),
        ElementsAre(Kind::write_after_read));
    EXPECT_THAT(
        hazards({use(1, kFill), change, use(1, kColorWrite)}),
        ElementsAre(Kind::write_after_write));
    EXPECT_THAT(hazards({change, use(1, kFragmentRead)}), ElementsAre(Kind::read_after_write));
    // A later layout change waits for the first one by its destination stage.
    EXPECT_THAT(hazards({change, imageBarrier(1, kColorWrite, kFragmentRead, true)}), IsEmpty());
    EXPECT_THAT(hazards({change, change}), ElementsAre(Kind::write_after_write));
}

TEST(HazardChecker, LetsOneCommandsUsesBe) {
    Recorded both = use(1, kComputeRead);
    both.uses.push_back({2, kComputeWrite});
    EXPECT_THAT(hazards({both}), IsEmpty());
    EXPECT_THAT(hazards({both, both}), ElementsAre(Kind::read_after_write));
}

TEST(HazardChecker, FollowsTheQueueFromSubmissionToSubmission) {
    HazardChecker checker;
    EXPECT_THAT(checker.submit({use(1, kComputeWrite, "first")}), IsEmpty());
    EXPECT_THAT(checker.submit({use(2, kComputeWrite), barrier(kFill, kFill)}), IsEmpty());
    const std::vector<Hazard> found = checker.submit({use(1, kComputeWrite, "third")});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].earlier, "first");
    EXPECT_THAT(
        checker.submit({barrier(kComputeWrite, kComputeWrite), use(1, kComputeWrite)}), IsEmpty());
}

TEST(HazardChecker, ForgetsWhatTheHostHasWaitedFor) {
    HazardChecker checker;
    checker.submit({use(1, kComputeWrite)});
    checker.submit({use(2, kComputeWrite)});
    checker.finish(1);
    EXPECT_THAT(checker.submit({use(1, kVertexRead)}), IsEmpty());
    EXPECT_EQ(checker.submit({use(2, kVertexRead)}).size(), 1u);
}

TEST(SuperfluousBarriers, AreThoseWithoutWhichThereIsNoMoreHazard) {
    const Recording needed{
        use(1, kComputeWrite), barrier(kComputeWrite, kVertexRead, "needed"),
        barrier(kVertexRead, kFragmentRead, "redundant"), use(1, kVertexRead)};
    EXPECT_THAT(redundantBarriers(std::span(&needed, 1)), ElementsAre("redundant"));
    const Recording twice{
        use(1, kComputeWrite), barrier(kComputeWrite, kVertexRead, "a"),
        barrier(kComputeWrite, kVertexRead, "b"), use(1, kVertexRead)};
    EXPECT_THAT(redundantBarriers(std::span(&twice, 1)), ElementsAre("a", "b"));
    // Only the next frame needs this barrier.
    const Recording frame{use(1, kComputeWrite), barrier(kComputeWrite, kComputeWrite, "last")};
    EXPECT_THAT(redundantBarriers(std::span(&frame, 1)), ElementsAre("last"));
    EXPECT_THAT(redundantBarriers(std::vector{frame, frame}), IsEmpty());
}

// ---- On a device --------------------------------------------------------------------------------

class HazardLogTest : public GpuTest {
protected:
    void SetUp() override {
        GpuTest::SetUp();
        if (!isOver()) device().hazards()->drop(std::nullopt);
    }

    static std::string messages() {
        std::string text;
        for (const std::string& message : device().messages().take()) text += message + '\n';
        return text;
    }

    static Buffer storage(const char* name) {
        return {device(), {.size = 64, .name = name, .purpose = "tests"}};
    }

    static Image picture() {
        return {
            device(),
            {.width = 8,
             .height = 8,
             .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
             .name = "planted picture",
             .purpose = "tests"}};
    }
};

TEST_F(HazardLogTest, FindsAMissingBarrierBetweenBuffers) {
    const Buffer a = storage("a");
    const Buffer b = storage("b");
    const auto record = [&](Commands& commands) {
        commands.fill(a, 1);
        commands.copy(a, b, 64);
    };
    runOnce(device(), record);
    EXPECT_EQ(messages(), "");
    device().hazards()->drop(0);
    runOnce(device(), record);
    EXPECT_THAT(messages(), HasSubstr("hazard: read after write of 'a': set-up is not ordered"));
    EXPECT_THAT(device().hazards()->dropped().value_or(""), HasSubstr("hazard_checker_test.cpp:"));
}

// The layer tracks images. Its message about a copy that does not wait for the picture's layout
// change shows that synchronization validation is active.
TEST_F(HazardLogTest, ThePlantedHazardOnAnImageIsSeenByTheValidationLayer) {
    const Image image = picture();
    const Buffer pixels(
        device(), {.size = 256, .usage = Usage::readback, .name = "pixels", .purpose = "tests"});
    const auto record = [&](Commands& commands) {
        commands.transition(image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        commands.copy(image, pixels);
    };
    runOnce(device(), record);
    EXPECT_EQ(messages(), "");
    device().hazards()->drop(0);
    runOnce(device(), record);
    const std::string found = messages();
    EXPECT_THAT(found, HasSubstr("SYNC-HAZARD-READ-AFTER-WRITE"));
    EXPECT_THAT(found, HasSubstr("hazard: read after write of 'planted picture'"));
}

TEST_F(HazardLogTest, FindsTheHostWritingWhatAFrameStillReads) {
    const Buffer numbers(
        device(), {.size = 64, .usage = Usage::upload, .name = "numbers", .purpose = "tests"});
    const Buffer copy = storage("copy");
    FrameLoop loop(device(), Timing::overlapped);
    const auto play = [&] {
        loop.frame([&](Passes& passes) {
            numbers.write(std::uint32_t{1});
            passes.pass("copies", PassKind::compute, [&](Commands& commands) {
                commands.copy(numbers, copy, 64);
            });
        });
    };
    play();
    EXPECT_EQ(messages(), "");
    play();
    EXPECT_THAT(messages(), HasSubstr("hazard: write after read of 'numbers': the host writes"));
    loop.finish();
    play();
    EXPECT_EQ(messages(), "");
}

}  // namespace
}  // namespace engine
