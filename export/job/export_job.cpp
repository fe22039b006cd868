// The entry points of the job: one pot to meshes in stores, to files, or to a report alone.

#include "claystack/export/job.hpp"

#include "claystack/core/atomic_file.hpp"
#include "core/cancel.hpp"
#include "core/text.hpp"
#include "export/formats/text_scanner.hpp"
#include "export/job/collapsed_export.hpp"
#include "export/job/prepare.hpp"
#include "export/job/revolved_export.hpp"
#include "export/job/section_sheet.hpp"
#include "export/job/stages.hpp"
#include "export/job/step_file.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace clay::solid::inline job {
namespace {

using Progress = std::function<void(std::string_view)>;

Result<ExportReport> run_prepared(const PreparedPot& pot, const std::vector<Output>& outputs,
                                  const ExportOptions& options, const Progress& progress) {
  return pot.pot.collapse ? export_collapsed(pot, outputs, options, progress)
                          : export_revolved(pot, outputs, options, progress);
}

/// The result of `work`, or the error of options out of range or of a cancelled job. Every entry
/// passes through here.
template <class Work>
auto guarded(const ExportOptions& options, Work work) -> decltype(work()) {
  if (auto valid = check_ranges(options); !valid) return tl::make_unexpected(valid.error());
  const CancelScope scope(options.cancelled ? &options.cancelled : nullptr);
  const auto stopped = [&](const std::string& why) {
    return named(decltype(work())(failure(ErrorKind::io, "export stopped: " + why)),
                 options.source);
  };
  try {
    return work();
  } catch (const Cancelled&) {
    return stopped("cancelled");
  } catch (const std::bad_alloc&) {
    return stopped("not enough memory");
  } catch (const std::exception& e) {
    return stopped(e.what());
  }
}

/// A file under construction: the exporters write to it and read it back.
class FileOnDisk final : public FileStore {
 public:
  explicit FileOnDisk(AtomicFile file) : file_(std::move(file)) {}

  Result<void> write(std::span<const std::byte> bytes) override { return file_.write(bytes); }
  [[nodiscard]] bool rereadable() const noexcept override { return file_.rereadable(); }
  Result<void> read_at(std::uint64_t offset, std::span<std::byte> bytes) const override {
    return file_.read_at(offset, bytes);
  }
  [[nodiscard]] AtomicFile& file() noexcept { return file_; }

 private:
  AtomicFile file_;
};

Result<std::unique_ptr<FileOnDisk>> open_file(const std::string& path) {
  return AtomicFile::create(path).map(
      [](AtomicFile created) { return std::make_unique<FileOnDisk>(std::move(created)); });
}

/// All files of a request, opened before any work, so that an unwritable file is reported at once.
class FilesExport {
 public:
  FilesExport(const Pot& pot, const ExportRequest& request, const Progress& progress)
      : pot_(pot), request_(request), options_(request.options), progress_(progress) {}

  Result<ExportReport> run() {
    return check()
        .and_then([&] { return open_all(); })
        .and_then([&] { return write_given(); })
        .and_then([&] { return run_job(); })
        .and_then([&] { return publish(); })
        .map([&] { return std::move(report_); });
  }

 private:
  struct OpenFile {
    const FileRequest* asked = nullptr;
    std::unique_ptr<FileOnDisk> file, certificate;
    FileReport report;  ///< of a file that is no mesh
  };

  Result<void> check() const {
    for (const FileRequest& asked : request_.files)
      if (auto possible = check(asked); !possible) return possible;
    if (auto names = check_names(); !names) return names;
    if (!request_.report_path.empty() && !request_.report_text)
      return wrong(request_.report_path, "expected a function for the text, found none");
    if (!pot_.collapse) return {};
    if (request_.certificates) return named(wrong("certificate", kStanding), options_.source);
    return named(check_collapsed_options(options_), options_.source);
  }

  /// No output replaces another one.
  [[nodiscard]] Result<void> check_names() const {
    std::vector<std::string> paths;
    for (const FileRequest& asked : request_.files) {
      paths.push_back(asked.path);
      if (has_certificate(asked)) paths.push_back(certificate_path(asked));
    }
    if (!request_.report_path.empty()) paths.push_back(request_.report_path);
    std::set<std::filesystem::path> places;
    for (const std::string& path : paths) {
      std::error_code ignored;
      if (!places.insert(std::filesystem::weakly_canonical(path, ignored)).second)
        return wrong(path, "expected one request for each file, found two");
    }
    return {};
  }
  [[nodiscard]] bool has_certificate(const FileRequest& asked) const {
    return request_.certificates && asked.kind == FileKind::mesh;
  }
  static std::string certificate_path(const FileRequest& asked) {
    return asked.path + ".certificate.json";
  }

  /// The ending of a file that is made from the section is right, and the pot can have it.
  [[nodiscard]] Result<void> check(const FileRequest& asked) const {
    if (asked.kind == FileKind::mesh || asked.kind == FileKind::given) return {};
    const SectionFile* known = section_file(asked.path);
    if (known == nullptr || known->kind != asked.kind)
      return wrong(asked.path, "expected a name that ends in " + section_endings());
    if (!pot_.collapse || known->name == "svg") return {};
    return wrong(asked.path,
                 std::string(kStanding) + "; of a collapsed pot only an .svg drawing is possible");
  }

  static Result<void> wrong(const std::string& place, const std::string& text) {
    return failure(ErrorKind::bad_input, place + ": " + text);
  }
  static constexpr const char* kStanding = "expected a standing pot, found a collapsed one";

  [[nodiscard]] bool asks(FileKind kind) const {
    return std::ranges::any_of(request_.files,
                               [&](const FileRequest& file) { return file.kind == kind; });
  }

  Result<void> open_all() {
    for (const FileRequest& asked : request_.files) {
      OpenFile& open = files_.emplace_back();
      open.asked = &asked;
      auto file = open_file(asked.path);
      if (!file) return tl::make_unexpected(file.error());
      open.file = std::move(*file);
      if (!has_certificate(asked)) continue;
      auto certificate = open_file(certificate_path(asked));
      if (!certificate) return tl::make_unexpected(certificate.error());
      open.certificate = std::move(*certificate);
    }
    if (request_.report_path.empty()) return {};
    return open_file(request_.report_path).map([&](std::unique_ptr<FileOnDisk> file) {
      report_file_ = std::move(file);
    });
  }

  Result<void> write_given() {
    for (OpenFile& open : files_)
      if (open.asked->kind == FileKind::given)
        if (auto written = write(open, open.asked->bytes); !written) return written;
    return {};
  }

  Result<void> run_job() {
    const bool drawn = asks(FileKind::section) && !pot_.collapse;
    const bool solid =
        asks(FileKind::mesh) || asks(FileKind::wall_table) || asks(FileKind::step) || drawn;
    stop_if_cancelled();
    if (!solid && !asks(FileKind::section)) return list_files({});
    if (asks(FileKind::wall_table)) options_.wall_spacing_mm = kWallTableSpacingMm;
    const auto pot = named(prepare(pot_, options_), options_.source);
    if (!pot) return tl::make_unexpected(pot.error());
    if (solid) {
      auto report = run_prepared(*pot, outputs(), options_, progress_);
      if (!report) return tl::make_unexpected(report.error());
      report_ = std::move(*report);
    }
    return write_companions(*pot).and_then(
        [&] { return list_files(std::exchange(report_.files, {})); });
  }

  std::vector<Output> outputs() const {
    std::vector<Output> outputs;
    for (const OpenFile& open : files_)
      if (open.asked->kind == FileKind::mesh)
        outputs.push_back({open.asked->format, open.file.get(), open.asked->path});
    return outputs;
  }

  Result<void> write_companions(const PreparedPot& pot) {
    auto mesh = report_.files.begin();
    for (OpenFile& open : files_) {
      Result<void> written;
      switch (open.asked->kind) {
        case FileKind::mesh:
          if (open.certificate)
            written = open.certificate->file().write(write_certificate(*mesh->certificate));
          ++mesh;
          break;
        case FileKind::wall_table:
          written = write(open, wall_table(report_.walls.field));
          break;
        case FileKind::step:
          written = write_step(open);
          break;
        case FileKind::section:
          written = drawing(open, pot).and_then(
              [&](const std::string& bytes) { return write(open, bytes); });
          break;
        case FileKind::given:
          break;
      }
      if (!written) return written;
    }
    return {};
  }

  static Result<void> write(OpenFile& open, const std::string& bytes) {
    open.report.bytes = bytes.size();
    return open.file->file().write(bytes);
  }

  Result<std::string> drawing(const OpenFile& open, const PreparedPot& pot) const {
    const std::string_view format = section_file(open.asked->path)->name;
    if (pot.pot.collapse) return section_svg(pot.pot);
    const Sheet sheet = section_sheet(report_, options_);
    if (format == "svg") return svg_of(sheet);
    return format == "dxf" ? dxf_of(sheet) : pdf_of(sheet);
  }

  Result<void> write_step(OpenFile& open) {
    Stages stages(report_.stages, progress_);
    return named(job::write_step(report_, options_, *open.file, stages), open.asked->path)
        .map([&](FileReport report) { open.report = std::move(report); });
  }

  /// One report for each file, in the order of the request.
  Result<void> list_files(std::vector<FileReport> meshes) {
    auto mesh = meshes.begin();
    for (const OpenFile& open : files_) {
      FileReport& file = report_.files.emplace_back();
      file = open.asked->kind == FileKind::mesh ? std::move(*mesh++) : open.report;
      file.path = open.asked->path;
      file.kind = open.asked->kind;
    }
    return {};
  }

  /// The report is written like the other files: all files are on the disk before the first gets
  /// its name.
  Result<void> publish() {
    stop_if_cancelled();
    std::vector<AtomicFile*> files;
    for (const OpenFile& open : files_) {
      files.push_back(&open.file->file());
      if (open.certificate) files.push_back(&open.certificate->file());
    }
    const auto begin = std::chrono::steady_clock::now();
    for (AtomicFile* file : files)
      if (auto prepared = file->prepare(); !prepared) return prepared;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    report_.stages.push_back({"publish", seconds.count()});
    if (report_file_) {
      if (auto written = report_file_->file().write(request_.report_text(report_)); !written)
        return written;
      files.push_back(&report_file_->file());
    }
    return commit_all(files);
  }

  const Pot& pot_;
  const ExportRequest& request_;
  ExportOptions options_;
  const Progress& progress_;
  std::vector<OpenFile> files_;
  std::unique_ptr<FileOnDisk> report_file_;
  ExportReport report_;
};

}  // namespace

const SectionFile* section_file(std::string_view path) noexcept {
  const std::size_t dot = path.rfind('.');
  const std::string_view ending = dot == path.npos ? "" : path.substr(dot);
  for (const SectionFile& file : kSectionFiles)
    if (equal_ignoring_case(ending, file.ending)) return &file;
  return nullptr;
}

std::string section_endings() {
  std::string text;
  for (std::size_t i = 0; i < kSectionFiles.size(); ++i) {
    const auto same = [&](std::size_t other) {
      return other < kSectionFiles.size() && kSectionFiles[other].kind == kSectionFiles[i].kind;
    };
    if (i > 0) text += same(i - 1) && !same(i + 1) ? " or " : ", ";
    text += kSectionFiles[i].ending;
    if (!same(i + 1)) text.append(" for the ").append(kSectionFiles[i].title);
  }
  return text;
}

Result<FileRequest> file_request(const std::string& path) {
  if (const SectionFile* file = section_file(path)) return FileRequest{path, file->kind};
  const auto format = mesh_format_of(path, FormatUse::write);
  if (format) return FileRequest{path, FileKind::mesh, *format};
  return failure(ErrorKind::bad_input, format.error().message + "; or " + section_endings());
}

Result<ExportReport> run_export(const Pot& pot, const std::vector<Output>& outputs,
                                const ExportOptions& options, const Progress& progress) {
  return guarded(options, [&] {
    return named(prepare(pot, options), options.source).and_then([&](const PreparedPot& ready) {
      return run_prepared(ready, outputs, options, progress);
    });
  });
}

Result<ExportReport> export_files(const Pot& pot, const ExportRequest& request,
                                  const Progress& progress) {
  return guarded(request.options, [&] { return FilesExport(pot, request, progress).run(); });
}

Result<ExportReport> preview_export(const Pot& pot, const ExportRequest& request,
                                    const Progress& progress) {
  std::vector<MemoryStore> stores(request.files.size());
  std::vector<Output> outputs;
  for (std::size_t i = 0; i < stores.size(); ++i)
    if (request.files[i].kind == FileKind::mesh)
      outputs.push_back({request.files[i].format, &stores[i], request.files[i].path});
  return run_export(pot, outputs, request.options, progress);
}

}  // namespace clay::solid::inline job
