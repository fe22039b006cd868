#include "app/cli/export_files.hpp"

#include "app/cli/console.hpp"
#include "app/cli/wall_table.hpp"
#include "claystack/core/atomic_file.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/formats.hpp"
#include "claystack/export/job.hpp"

#include <algorithm>
#include <span>

namespace clay::cli {
namespace {

using solid::MeshFormat;

bool is_pot(const Request& request) { return pot_encoding_of(request.path).has_value(); }
bool is_mesh(const Request& request) { return request.mesh.has_value(); }

std::string certificate_path(const std::string& file) { return file + ".certificate.json"; }

Result<Request> request_of(const std::string& path, bool ascii) {
  Request request{path, std::nullopt, nullptr, nullptr};
  if (path.ends_with(".svg") || is_wall_table(path) || is_pot(request)) return request;
  const auto format = solid::mesh_format_of(path);
  if (!format)
    return failure(ErrorKind::bad_input, format.error().message +
                                             "; or .svg for the section, .csv for its walls, "
                                             ".pot.json or .pot.cbor for the pot");
  request.mesh = *format == MeshFormat::stl_binary && ascii ? MeshFormat::stl_ascii : *format;
  return request;
}

Result<void> check_names(const ExportCommand& command) {
  std::vector<std::string> outputs = command.outputs;
  outputs.push_back(command.report);
  if (command.certificate)
    for (const std::string& path : command.outputs) outputs.push_back(certificate_path(path));
  return check_distinct(outputs, {command.pot});
}

Result<void> check_options(const ExportCommand& command, const std::vector<Request>& requests) {
  const auto need = [&](bool option, std::string_view name, std::string_view kind,
                        auto is) -> Result<void> {
    if (!option || std::ranges::any_of(requests, is)) return {};
    return failure(ErrorKind::bad_input, std::string(name)
                                             .append(": expected ")
                                             .append(kind)
                                             .append(" among the files to write, found none"));
  };
  const auto format = [](MeshFormat wanted) {
    return [wanted](const Request& request) { return request.mesh == wanted; };
  };
  return need(command.precision_mm.has_value(), "--precision", "a pot", is_pot)
      .and_then([&] { return need(command.certificate, "--certificate", "a mesh", is_mesh); })
      .and_then([&] {
        return need(command.options.shrinkage > 0.0, "--shrinkage", "a mesh or its section",
                    [](const Request& request) { return !is_pot(request); });
      })
      .and_then([&] {
        return need(command.walls.asked(), "--min-wall and --process", "a mesh", is_mesh);
      })
      .and_then(
          [&] { return need(command.ascii, "--ascii", "an .stl", format(MeshFormat::stl_ascii)); })
      .and_then([&] {
        return need(command.options.normals, "--normals", "an .obj", format(MeshFormat::obj));
      });
}

}  // namespace

Result<std::vector<Request>> requests_of(const ExportCommand& command) {
  if (auto names = check_names(command); !names) return tl::make_unexpected(names.error());
  std::vector<Request> requests;
  for (const std::string& path : command.outputs) {
    auto request = request_of(path, command.ascii);
    if (!request) return tl::make_unexpected(request.error());
    requests.push_back(std::move(*request));
  }
  return check_options(command, requests).map([&] { return std::move(requests); });
}

Result<std::unique_ptr<FileOnDisk>> open_file(const std::string& path) {
  if (path.empty()) return nullptr;
  return AtomicFile::create(path).map(
      [](AtomicFile created) { return std::make_unique<FileOnDisk>(std::move(created)); });
}

Result<void> open_all(std::vector<Request>& requests, const ExportCommand& command) {
  for (Request& request : requests) {
    auto file = open_file(request.path);
    if (!file) return tl::make_unexpected(file.error());
    request.file = std::move(*file);
    if (!request.mesh || !command.certificate) continue;
    auto certificate = open_file(certificate_path(request.path));
    if (!certificate) return tl::make_unexpected(certificate.error());
    request.certificate = std::move(*certificate);
  }
  return {};
}

Result<void> write_text(FileOnDisk& file, const std::string& text) {
  return file.write(std::as_bytes(std::span(text)));
}

Result<std::vector<PotCopy>> write_copies(const Pot& pot, std::vector<Request>& requests,
                                          const ExportCommand& command) {
  const auto copied = command.precision_mm ? rounded_pot(pot, *command.precision_mm) : pot;
  if (!copied) return failure(copied.error().kind, command.pot + ": " + copied.error().message);
  std::vector<PotCopy> copies;
  for (Request& request : requests) {
    const auto encoding = pot_encoding_of(request.path);
    if (!encoding) continue;
    const std::string bytes = write_pot(*copied, *encoding);
    if (auto written = write_text(*request.file, bytes); !written)
      return tl::make_unexpected(written.error());
    copies.push_back(describe_copy(*copied, *encoding, bytes.size()));
  }
  return copies;
}

Result<void> write_companions(const Pot& pot, const solid::ExportReport& report,
                              std::vector<Request>& requests, double shrinkage) {
  const auto larger = solid::enlarged(pot, shrinkage);
  if (!larger) return tl::make_unexpected(larger.error());
  auto mesh = report.files.begin();
  for (Request& request : requests) {
    Result<void> written;
    if (request.certificate)
      written = write_text(*request.certificate, solid::write_certificate(*mesh->certificate));
    else if (is_wall_table(request.path))
      written = write_text(*request.file, wall_table(report.wall_field));
    else if (!is_mesh(request) && !is_pot(request))
      written = write_text(*request.file, solid::section_svg(*larger));
    if (!written) return written;
    if (is_mesh(request)) ++mesh;
  }
  return {};
}

std::vector<AtomicFile*> files_of(const std::vector<Request>& requests) {
  std::vector<AtomicFile*> files;
  for (const Request& request : requests) {
    files.push_back(&request.file->file());
    if (request.certificate) files.push_back(&request.certificate->file());
  }
  return files;
}

}  // namespace clay::cli
