#pragma once
#include "app/cli/console.hpp"
#include "claystack/core/result.hpp"

#include <string>

namespace clay::cli {

/// A recorded session to throw, and the files to write; an empty name is a file that is not wanted.
struct ReplayJob {
  std::string scene;
  std::string session;
  std::string from;   ///< pot to continue; empty: the scene's lump
  std::string model;  ///< empty: the model of the scene
  std::string pot;
  std::string trace;
  std::string error_plot;
};

/// Plays the session, writes all files or none, and prints the result.
Result<void> throw_replay(const ReplayJob& job, Console console);

}  // namespace clay::cli
