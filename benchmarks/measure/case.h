#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/frame_loop.h"
#include "hair/groom/groom.h"
#include "hair/groom/mesh/deforming_mesh.h"
#include "hair/groom/mesh/mesh.h"
#include "hair/rendering/groom_buffers.h"
#include "hair/rendering/render_assets.h"
#include "hair/rendering/renderer.h"
#include "hair/rendering/strand_points.h"
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"
#include "hair/simulation/simulation.h"

// One set of settings, ready to play.
namespace benchmarks::measure {

class HairCache;

// One set of settings, ready to play: the groom, its simulation and its renderer. Owns every GPU
// object that it uses; leaving its scope frees them.
class Case {
public:
    // `directory` is what file names in the settings are relative to. Throws engine::Error for
    // files that can't be used, engine::Unsupported for what the device lacks. What `cache` knows
    // is not made again, and what it does not is left there; null: there is none.
    Case(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, HairCache* cache = nullptr);

    // Records the next frame: simulated time advances by /run/frame_time, then a picture is drawn.
    void frame(engine::Passes& passes);

    // Records the simulation of the next frame and no picture: what frame() does first.
    void simulate(engine::Passes& passes);

    // Records a picture of the frame as it is: what frame() does last.
    void draw(engine::Passes& passes);

    // Draws the same hair otherwise from now on: `settings` may differ from the case's in anything
    // but /groom, /simulation, /seed and /run. The device must be done with what was submitted. As
    // the constructor throws; nothing has changed then.
    void setDrawing(const hair::Settings& settings);
    // Sets /camera alone, at no cost.
    void setCamera(const hair::CameraSettings& camera);

    // Goes on from here with the wind, colliders, motion and pulls of `settings`, which are the
    // same in everything else. What is shown from now on is no frame of these settings until the
    // case is made anew. The device must be done with what was submitted. As the constructor
    // throws.
    void carryOn(const hair::SimulationSettings& settings);

    // Records the way back to the first frame, after all that was recorded or submitted before.
    void recordReset(engine::Passes& passes);
    // The same at once. The device must be done with what was submitted.
    void reset();

    // The picture of the last frame on the device, in TRANSFER_SRC_OPTIMAL.
    const engine::Image& output() const { return renderer_->target().output(); }
    // The picture of the last frame, [row][column] RGBA, top row first.
    std::vector<std::uint8_t> picture() const;
    std::string pictureHash() const;
    // The picture's linear light, [row][column] RGB: before exposure and tone map, or, where there
    // is no tone map, what a display shows.
    std::vector<float> radiance() const;
    // Hash of the guides' positions.
    std::string stateHash() const;

    // The strands of the last frame as they are drawn. Waits for the device.
    hair::rendering::StrandPoints strands() const;
    // The guides of the last frame, [guide][vertex], m. Waits for the device.
    std::vector<glm::vec3> guides() const { return simulation_.readPositions(); }
    const hair::groom::Groom& groom() const { return groom_; }
    // What is odd about what the case was given, though it can be played.
    std::vector<std::string> warnings() const { return simulation_.bodyWarnings(); }
    // Where the head is in the last frame; where an animation deforms it, where its scalp is on
    // average.
    hair::simulation::RigidMotion head() const { return simulation_.pose(); }
    // What takes the mesh under the hair to where the last frame has it: deform() where an
    // animation does so, then this.
    hair::simulation::RigidMotion carried() const { return simulation_.carried(); }
    // `mesh` is the one under the hair.
    void deform(hair::groom::Mesh& mesh) const;

    const hair::Settings& settings() const { return settings_; }

    // How the guides are in the last frame, and what /simulation/rest made of them. Wait for the
    // device.
    hair::simulation::GuideCondition condition() const { return simulation_.condition(); }
    const hair::simulation::RestBalance* balance() const { return simulation_.balance(); }

    // For other pictures of the same hair: `settings` may differ from the case's in how it is lit,
    // seen and drawn, but not in what /groom, /simulation, /seed and /strands make of it.
    hair::rendering::Renderer rendererOf(const hair::Settings& settings) const;
    hair::rendering::StrandView view() const;

    const hair::rendering::StrandPlan& plan() const { return renderer_->plan(); }
    std::optional<hair::rendering::ExpectedCounts> expected() const {
        return renderer_->expected();
    }
    std::vector<std::pair<std::string, std::uint64_t>> counts() const;
    // What draws the strands, and why; absent where no hair is drawn.
    std::optional<hair::rendering::BackendChoice> backend() const;
    // What becomes of the strands' fragments, and what of the last frame's.
    const hair::rendering::StrandBlend& blend() const { return renderer_->blend(); }

private:
    hair::rendering::GroomBuffers groomBuffers(const hair::Settings& settings) const;
    hair::rendering::StrandView viewOf(const hair::rendering::GroomBuffers& buffers) const;

    const engine::Device& device_;
    hair::Settings settings_;
    std::filesystem::path directory_;
    std::optional<hair::groom::Mesh> mesh_;
    hair::groom::Groom groom_;
    std::unique_ptr<hair::groom::DeformingMesh> deforming_;  // null: the mesh keeps its shape
    hair::simulation::Simulation simulation_;
    hair::simulation::FixedStep fixed_step_;
    std::unique_ptr<hair::rendering::GroomBuffers> groom_buffers_;
    std::unique_ptr<hair::rendering::Renderer> renderer_;
};

// What the last picture lacks for want of room in its lists of fragments; empty: nothing. Waits for
// the device.
std::string droppedFragments(const Case& test_case);

// What a simulation leaves, as strands for a file; lengths in m.

// Strands as they are drawn: joints of segments once, without what is not drawn.
hair::groom::StrandSet drawnStrands(const hair::rendering::StrandPoints& points);

// The guides, at `positions`, [guide][vertex].
hair::groom::StrandSet
guideStrands(const hair::groom::Groom& groom, std::vector<glm::vec3> positions);

}  // namespace benchmarks::measure
