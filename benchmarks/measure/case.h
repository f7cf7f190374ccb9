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
#include "hair/settings.h"
#include "hair/simulation/head_motion.h"
#include "hair/simulation/probes.h"
#include "hair/simulation/simulation.h"

// A case: one set of settings, ready to play.
namespace benchmarks::measure {

class HairCache;

// One set of settings, ready to play: the groom, its simulation and its renderer. Owns all GPU
// objects that it uses; its destructor frees them. If the heads of /copies have a simulation each,
// then guides(), strands(), head() and probes are those of the first head.
class Case {
public:
    // File names in the settings are relative to `directory`. Data in `cache` is reused, and new
    // data is added to it; null: no cache. Throws engine::Error for files that can't be used,
    // engine::Unsupported if the device lacks a feature.
    Case(
        const engine::Device& device, const hair::Settings& settings,
        const std::filesystem::path& directory, HairCache* cache = nullptr);

    // Records the next frame: advances simulated time by /run/frame_time, then draws a picture.
    void frame(engine::Passes& passes);

    // Records only the simulation of the next frame: the first part of frame().
    void simulate(engine::Passes& passes);

    // Records the pass `probe` of the current frame.
    void probe(engine::Passes& passes, hair::simulation::Probes& probes);
    // Simulated time of the current frame, s.
    double time() const { return simulation_.time(); }

    // Records only a picture of the current frame: the last part of frame().
    void draw(engine::Passes& passes);

    // Draws the same hair with other settings from now on. `settings` may differ from the case's in
    // everything except /groom, /simulation, /seed and /run. The device must have finished all
    // submitted work. Throws like the constructor and then changes nothing.
    void setDrawing(const hair::Settings& settings);
    // Sets only /camera, at no cost.
    void setCamera(const hair::CameraSettings& camera);

    // Continues from here with the wind, colliders, motion and pulls of `settings`; all other
    // settings must be the same. From now on the frames do not belong to these settings, until the
    // case is recreated. The device must have finished all submitted work. Throws like the
    // constructor.
    void carryOn(const hair::SimulationSettings& settings);

    // Records a reset to the first frame, after all recorded and submitted work.
    void recordReset(engine::Passes& passes);
    // Resets at once. The device must have finished all submitted work.
    void reset();

    // The picture of the last frame on the device, in TRANSFER_SRC_OPTIMAL.
    const engine::Image& output() const { return renderer_->target().output(); }
    // The picture of the last frame, [row][column] RGBA, top row first.
    std::vector<std::uint8_t> picture() const;
    std::string pictureHash() const;
    // The picture's linear light, [row][column] RGB: before exposure and tone map. Without a tone
    // map, it is the light of the display colours.
    std::vector<float> radiance() const;
    // Hash of the guides' positions.
    std::string stateHash() const;

    // The strands of the last frame as they are drawn. Waits for the device.
    hair::rendering::StrandPoints strands() const;
    // The guides of the last frame, [guide][vertex], m. Waits for the device. Throws engine::Error
    // if the simulation has failed: a position is not finite or a guide is longer than
    // mostStretch(). So do picture(), radiance(), stateHash() and strands(): a wrong outcome is
    // neither measured nor written. strands() also refuses a drawn point that is not finite.
    std::vector<glm::vec3> guides() const;
    // The guides as drawn: with /run/interpolate between the last two steps, otherwise guides().
    std::vector<glm::vec3> drawnGuides() const;
    const hair::groom::Groom& groom() const { return groom_; }
    // Loads /run/probes/reference; nothing if it is empty. Throws engine::Error.
    std::optional<hair::groom::StrandSet> probeReference() const;
    // Oddities of the input that do not prevent playing.
    std::vector<std::string> warnings() const { return simulation_.bodyWarnings(); }
    // Pose of the head in the last frame. If an animation deforms the head, it is the average pose
    // of its scalp.
    hair::simulation::RigidMotion head() const { return simulation_.drawnPose(); }
    // Motion that takes the mesh under the hair to its pose in the last frame. If an animation
    // deforms the mesh, call deform() first.
    hair::simulation::RigidMotion carried() const { return simulation_.drawnCarried(); }
    // Deforms `mesh`, the mesh under the hair, to the last frame.
    void deform(hair::groom::Mesh& mesh) const;

    const hair::Settings& settings() const { return settings_; }

    // Condition of the guides in the last frame, and the result of /simulation/rest. Both wait for
    // the device.
    hair::simulation::GuideCondition condition() const { return simulation_.condition(); }
    const hair::simulation::RestBalance* balance() const { return simulation_.balance(); }

    // For other pictures of the same hair. `settings` may differ from the case's in lighting, view
    // and drawing, but not in the effects of /groom, /simulation, /seed and /strands.
    hair::rendering::Renderer rendererOf(const hair::Settings& settings) const;
    hair::rendering::StrandView view() const;
    // For Renderer::record(): of all heads, or one for each.
    std::vector<hair::rendering::StrandView> views() const;

    const hair::rendering::StrandPlan& plan() const { return renderer_->plan(); }
    std::optional<hair::rendering::ExpectedCounts> expected() const {
        return renderer_->expected();
    }
    std::vector<std::pair<std::string, std::uint64_t>> counts() const;
    // The back end that draws the strands, and the reason for the choice. Absent if no hair is
    // drawn.
    std::optional<hair::rendering::BackendChoice> backend() const;
    // Handling of the strands' fragments, and counts of the last frame.
    const hair::rendering::StrandBlend& blend() const { return renderer_->blend(); }

private:
    hair::rendering::GroomBuffers groomBuffers(const hair::Settings& settings) const;
    std::vector<std::unique_ptr<hair::simulation::Simulation>>
    simulationsOfOthers(HairCache* cache) const;
    hair::rendering::StrandView viewOf(
        const hair::rendering::GroomBuffers& buffers,
        const hair::simulation::Simulation& simulation) const;
    // The guides of a simulation; throws as guides() does.
    std::vector<glm::vec3> soundGuides(const hair::simulation::Simulation& simulation) const;
    void findViews(std::vector<hair::rendering::StrandView>& views) const;
    // Calls each(simulation) for the simulations of all heads.
    template <class Each>
    void forSimulations(Each each) {
        each(simulation_);
        for (const auto& other : others_) each(*other);
    }

    const engine::Device& device_;
    hair::Settings settings_;
    std::filesystem::path directory_;
    std::optional<hair::groom::Mesh> mesh_;
    hair::groom::Groom groom_;
    std::unique_ptr<hair::groom::DeformingMesh> deforming_;  // null: the mesh keeps its shape
    hair::simulation::Simulation simulation_;  // of the first head, or of all heads
    // Those of the other heads, if each has its own.
    std::vector<std::unique_ptr<hair::simulation::Simulation>> others_;
    hair::simulation::FixedStep fixed_step_;
    std::unique_ptr<hair::rendering::GroomBuffers> groom_buffers_;
    std::unique_ptr<hair::rendering::Renderer> renderer_;
    std::vector<hair::rendering::StrandView> views_;  // of the last picture recorded
};

// Describes fragments missing from the last picture because its fragment lists were full; empty if
// none. Waits for the device.
std::string droppedFragments(const Case& test_case);

// Results of a simulation as strands for a file; lengths in m.

// Strands as they are drawn. Joints of segments appear once, and undrawn points are omitted.
hair::groom::StrandSet drawnStrands(const hair::rendering::StrandPoints& points);

// Returns the powers of the colours of their points: shaders/strands/own_color.glsl.
std::vector<float> drawnPowers(const hair::rendering::StrandPoints& points);

// The guides at `positions`, [guide][vertex].
hair::groom::StrandSet
guideStrands(const hair::groom::Groom& groom, std::vector<glm::vec3> positions);

}  // namespace benchmarks::measure
