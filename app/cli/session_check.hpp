#pragma once
// Warnings about a session, before and after it is played.

#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"
#include "claystack/engine/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace clay::cli {

/// The names of the files of a replay, for messages.
struct ReplayFiles {
  std::string session;
  std::string scene;  ///< empty: the pot holds the tool and the clay
  std::string from;   ///< the pot that the throw continues; empty: the scene's lump
};

/// A cut last line; a session of another scene. `any_model`: the user has chosen one.
std::vector<std::string> session_warnings(const Session& session, const SceneSpec& scene,
                                          const ReplayFiles& files, bool any_model);
/// Refuses poses of two tools in a scene with one tool: the wheel would refuse them one by one.
Result<void> check_gaps(const Session& session, const SceneSpec& scene, const ReplayFiles& files);
/// After the replay. `refused`: poses that the wheel did not play; `ring_limit`: clay was above the
/// top ring.
std::vector<std::string> replay_warnings(std::size_t refused, bool ring_limit);

}  // namespace clay::cli
