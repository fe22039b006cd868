#pragma once
#include "claystack/core/result.hpp"
#include "claystack/engine/files.hpp"

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace clay::servo {

/// A session that is being recorded. It grows in NAME.recording, locked, and becomes NAME in one
/// step in `finish`: until then the session with that name does not change. A killed program leaves
/// NAME.recording, which can be played like any session. A recording without a pose leaves no file
/// and replaces none. Pipes and devices have no NAME.recording: lines are written to them directly.
class SessionRecording final : public PoseSink {
 public:
  /// Refused while another program records to this name, and if NAME.recording holds poses of an
  /// unfinished recording. `scene_hash`: hash_of the scene file.
  static Result<std::unique_ptr<SessionRecording>> begin(const std::string& path,
                                                         std::string_view scene_name,
                                                         std::uint64_t scene_hash);
  ~SessionRecording() override;
  SessionRecording(const SessionRecording&) = delete;
  SessionRecording& operator=(const SessionRecording&) = delete;

  Result<void> append(const PoseBlock& block) override;
  Result<void> finish() override;

 private:
  explicit SessionRecording(const std::string& path) : path_(path) {}
  Result<void> open_in_place();
  Result<void> open_aside();
  Result<void> lock_aside();
  Result<void> clear_aside();
  Result<void> write(std::string_view text);
  void discard() noexcept;
  [[nodiscard]] tl::unexpected<Error> failed(const char* action) const;

  std::string path_;              ///< path as given
  std::filesystem::path target_;  ///< path with symbolic links resolved
  std::filesystem::path aside_;   ///< empty: written in place
  bool owns_aside_ = false;       ///< it holds nothing but this recording
  int descriptor_ = -1;
  std::size_t poses_ = 0;  ///< number of poses recorded
};

}  // namespace clay::servo
