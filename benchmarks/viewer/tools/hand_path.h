#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "benchmarks/viewer/tools/moment.h"
#include "hair/simulation_settings.h"

namespace benchmarks {

// The path of a hand that the mouse drags, key by key while frames are played. What was played
// keeps its keys: playing the path anew gives the same hair.

// Straight between keys; before the first and after the last where these are. There is a key.
glm::vec3 handAt(std::span<const hair::PullKey> path, float time);

// The hand is at `position` from the next frame on, and stays there.
void moveHand(std::vector<hair::PullKey>& path, const Moment& moment, glm::vec3 position);

// The pull ends now; one that no frame was played of pulls for the next frame. Empty where it would
// have begun after now, because time was set back.
void letGo(std::vector<hair::PullKey>& path, const Moment& moment);

// Whether moveHand has room for its keys.
bool hasRoom(std::span<const hair::PullKey> path);

}  // namespace benchmarks
