#pragma once
// Options that have an effect on some kinds of files only.

#include "claystack/core/result.hpp"
#include "claystack/export/job.hpp"

#include <span>
#include <string_view>

namespace clay::cli {

[[nodiscard]] inline bool is_pot(const solid::FileRequest& file) {
  return file.kind == solid::FileKind::given;
}
[[nodiscard]] inline bool is_made(const solid::FileRequest& file) { return !is_pot(file); }
[[nodiscard]] inline bool is_step(const solid::FileRequest& file) {
  return file.kind == solid::FileKind::step;
}
[[nodiscard]] inline bool is_mesh(const solid::FileRequest& file) {
  return file.kind == solid::FileKind::mesh;
}
[[nodiscard]] inline bool is_solid(const solid::FileRequest& file) {
  return is_mesh(file) || is_step(file);
}
template <solid::MeshFormat... Formats>
[[nodiscard]] bool is_format(const solid::FileRequest& file) {
  return is_mesh(file) && ((file.format == Formats) || ...);
}

/// An option and the files on which it has an effect.
struct FileOption {
  bool given;
  std::string_view name, kind;
  bool (*fits)(const solid::FileRequest&);
};

/// Options of single formats. The name is that of the caller: "--glb" or "glb".
[[nodiscard]] inline FileOption step_option(bool given, std::string_view name) {
  return {given, name, "a .step", is_step};
}
[[nodiscard]] inline FileOption glb_option(bool given, std::string_view name) {
  return {given, name, "a .glb", is_format<solid::MeshFormat::glb>};
}
[[nodiscard]] inline FileOption colour_option(bool given, std::string_view name) {
  return {given, name, "a .glb or a .3mf",
          is_format<solid::MeshFormat::glb, solid::MeshFormat::three_mf>};
}
[[nodiscard]] inline FileOption facet_option(bool given, std::string_view name) {
  return {given, name, "a mesh", is_mesh};
}

/// Refuses a given option that has no effect on any of the files.
[[nodiscard]] Result<void> check_file_options(std::span<const FileOption> options,
                                              std::span<const solid::FileRequest> files);

}  // namespace clay::cli
