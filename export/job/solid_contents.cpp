#include "export/job/solid_contents.hpp"

#include "core/text.hpp"

namespace clay::solid::inline job {

FileContents solid_contents(const ExportOptions& options) {
  FileContents contents{.name = options.name};
  contents.draco.max_error_mm = options.tolerance_mm;
  contents.glb = options.glb;
  contents.material = options.material;
  if (const auto& process = options.walls.process)
    contents.notes.emplace_back("process", process->name);
  if (options.shrinkage > 0.0)
    contents.notes.emplace_back("shrinkage", number_text(options.shrinkage));
  contents.pot = options.pot_file;
  return contents;
}

std::string thumbnail_for(MeshFormat format, const ExportOptions& options) {
  return format == MeshFormat::three_mf && options.draw_thumbnail ? options.draw_thumbnail()
                                                                  : std::string();
}

}  // namespace clay::solid::inline job
