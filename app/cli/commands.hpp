#pragma once
// One function per command. Each registers itself with the parser and returns its status through
// `exit`.

#include "app/cli/console.hpp"

#include <CLI/App.hpp>

#include <string>

namespace clay::cli {

void add_throw_command(CLI::App& app, Console& console, int& exit);
void add_strokes_command(CLI::App& app, Console& console, int& exit);
void add_plan_command(CLI::App& app, Console& console, int& exit);
#ifdef CLAYSTACK_EXPORT
void add_export_command(CLI::App& app, Console& console, int& exit);
void add_check_command(CLI::App& app, Console& console, int& exit);
#endif
#ifdef CLAYSTACK_DRAWINGS
void add_import_command(CLI::App& app, Console& console, int& exit);
#endif
#ifdef CLAYSTACK_WINDOW
void add_render_command(CLI::App& app, Console& console, int& exit);
#endif
#ifdef CLAYSTACK_USB
void add_devices_command(CLI::App& app, Console& console, int& exit);
#endif
#ifdef CLAYSTACK_STUDIO
void add_studio_command(CLI::App& app, int& exit);
#endif
void add_doctor_command(CLI::App& app, Console& console, int& exit);
void add_batch_command(CLI::App& app, Console& console, int& exit);
/// Hidden: prints manual pages and completions, for packages.
void add_manual_command(CLI::App& app, int& exit);
/// Only if CLAYSTACK_BENCH is on.
void add_bench_command(CLI::App& app, Console& console, int& exit);

/// Program, version, compiler and build options.
[[nodiscard]] std::string version_text();

}  // namespace clay::cli
