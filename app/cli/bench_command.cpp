#include "app/cli/commands.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/output_files.hpp"
#include "app/cli/usage.hpp"

#include "app/bench/registered_sections.hpp"
#include "app/bench/report/report.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/line_reader.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace clay::cli {
namespace {

struct BenchOptions {
  bool quick = false;
  bool extremes = false;
  std::vector<std::string> only;
  std::string report;
  std::string csv;
  std::string svg;
};

/// The command line as typed, without options that do not affect the measurement.
std::string command_line(const BenchOptions& options, const Console& console) {
  std::string line = "claystack bench";
  if (options.quick) line += " --quick";
  if (options.extremes)
    line += " --extremes";
  else if (!options.only.empty())
    line += fmt::format(" --only {}", fmt::join(options.only, ","));
  if (!options.report.empty()) line += " --report " + options.report;
  if (!options.csv.empty()) line += " --csv " + options.csv;
  if (!options.svg.empty()) line += " --svg " + options.svg;
  return console.json ? line + " --json" : line;
}

/// Checks before measuring that the folder is writable.
Result<void> open_folder(const std::string& folder) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(ErrorKind::io, folder + ": " + error.message());
  const auto probe = AtomicFile::create(std::filesystem::path(folder) / "claystack.csv");
  if (!probe) return tl::make_unexpected(probe.error());
  return {};
}

using Files = std::vector<std::pair<std::string, std::string>>;

Result<void> write_into(const std::string& folder, const Files& files,
                        std::vector<AtomicFile>& written) {
  for (const auto& [name, content] : files) {
    auto file = AtomicFile::create(std::filesystem::path(folder) / name);
    if (!file) return tl::make_unexpected(file.error());
    if (auto done = file->write(content); !done) return done;
    written.push_back(std::move(*file));
  }
  return {};
}

/// The page and the files of both folders: all of them or none.
Result<void> publish_report(const bench::Report& report, const BenchOptions& options,
                            std::optional<AtomicFile> page) {
  std::vector<AtomicFile> written;
  if (page) {
    if (auto done = page->write(bench::html_of(report)); !done) return done;
    written.push_back(std::move(*page));
  }
  if (!options.csv.empty())
    if (auto done = write_into(options.csv, bench::csv_files(report), written); !done) return done;
  if (!options.svg.empty())
    if (auto done = write_into(options.svg, bench::svg_files(report), written); !done) return done;
  std::vector<AtomicFile*> files;
  for (AtomicFile& file : written) files.push_back(&file);
  return commit_all(files);
}

void measure(bench::Report& report, const std::vector<bench::RegisteredSection>& chosen,
             const BenchOptions& options, const Console& console) {
  bench::Effort effort;
  effort.quick = options.quick;
  Progress progress(console, "measuring", 0);
  for (const auto& section : chosen) {
    const std::string name(section.id);
    effort.progress = [&](std::string_view stage) {
      progress.stage(name + ", " + std::string(stage));
    };
    progress.stage(name);
    report.sections.push_back(section.measure(effort));
  }
}

void print_section(const bench::Section& section, const Console& console) {
  const std::string text = bench::text_of(section);
  LineReader lines(text);
  while (const auto line = lines.next()) console.print(*line);
  console.print("");
}

Result<int> run_bench(BenchOptions options, Console console) {
  if (options.extremes) options.only = {"extremes"};
  const auto chosen = bench::chosen_sections(options.only);
  if (!chosen) return tl::make_unexpected(chosen.error());
  if (options.report == "-") console.quiet = true;
  if (auto free = check_outputs({{options.report, {".html"}}}, {}, console); !free)
    return tl::make_unexpected(free.error());
  for (const std::string& folder : {options.csv, options.svg})
    if (auto free = check_output_folder(folder, console); !free)
      return tl::make_unexpected(free.error());
  for (const std::string& folder : {options.csv, options.svg})
    if (auto opened = open_folder(folder); !opened) return tl::make_unexpected(opened.error());
  std::optional<AtomicFile> page;
  if (!options.report.empty()) {
    auto file = AtomicFile::create(options.report);
    if (!file) return tl::make_unexpected(file.error());
    page.emplace(std::move(*file));
  }

  bench::Report report{bench::this_machine(), command_line(options, console), {}};
  measure(report, *chosen, options, console);
  if (auto published = publish_report(report, options, std::move(page)); !published)
    return tl::make_unexpected(published.error());
  if (console.json) print_json(bench::json_of(report));
  for (const bench::Section& section : report.sections) print_section(section, console);
  for (const bench::Section& section : report.sections)
    for (const std::string& missed : section.missed)
      console.warn("required bound not met: " + section.id + ": " + missed);
  return report.sound() ? kDone : kUnsound;
}

std::string section_list() {
  std::string list;
  for (const auto& section : bench::registered_sections())
    list.append(list.empty() ? "" : ",").append(section.id);
  return list;
}

}  // namespace

void add_bench_command(CLI::App& app, Console& console, int& exit) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand(
      "bench", "Measure: speed, error against run time, convergence, extremes, the closed loop");
  command->add_flag("--quick", options->quick, "Fewer repetitions: ends within three minutes");
  auto* const only =
      command->add_option("--only", options->only, "Sections to measure: " + section_list())
          ->type_name("SECTION")
          ->delimiter(',');
  command->add_flag("--extremes", options->extremes, "The same as --only extremes")->excludes(only);
  add_file(*command, "--report", options->report, "HTML file for all tables and plots");
  command->add_option("--csv", options->csv, "Folder for one CSV file per table, plot and map")
      ->type_name("FOLDER");
  command->add_option("--svg", options->svg, "Folder for one SVG file per plot and map")
      ->type_name("FOLDER");
  command->footer(
      "\nExamples:\n  claystack bench --quick --report bench.html\n"
      "  claystack bench --only tick,left_out --json\n"
      "  claystack bench --report bench.html --csv figures\n\n"
      "Exit status: 0 every required bound holds; 1 one does not.");
  command->callback([options, &console, &exit] {
    const auto done = run_bench(*options, console);
    exit = done ? *done : report(done.error());
  });
}

}  // namespace clay::cli
