#pragma once
// The results of a measurement, independent of the output format: numbers, tables and plots. One
// writer each for text, JSON, CSV and HTML.

#include "app/bench/statistics.hpp"
#include "app/chart/plot.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::bench {

/// A measured number: median and interquartile range of the repetitions.
struct Value {
  std::string name;  ///< key in JSON, with its unit: n200_ns
  double median = 0.0;
  double spread = 0.0;  ///< interquartile range; 0 for counted values, which have none
  std::string about;    ///< description
};

/// Nothing, a verdict, a count, a number, or text.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Column {
  std::string name;  ///< key in JSON
  std::string unit;  ///< may be empty
};

struct Table {
  std::string id;  ///< unique in the report: key in JSON, name of the CSV file
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  std::string note;
};

using chart::Axis;
using chart::Curve;
using chart::Map;
using chart::Plot;

struct Section {
  std::string id;  ///< the name for --only
  std::string title;
  std::string summary;  ///< question, method and result
  std::vector<Value> values;
  std::vector<Table> tables;
  std::vector<Plot> plots;
  std::vector<Map> maps;
  std::vector<std::string> missed;  ///< required bounds that do not hold, with the measured value

  [[nodiscard]] bool sound() const { return missed.empty(); }
  /// Adds `missing` to the missed requirements unless `holds`.
  void require(bool holds, std::string missing);
};

/// Adds a value with a bound that it must keep. A noisy value misses the bound if three quarters of
/// its repetitions miss it; a counted value, which has no spread, if it exceeds the bound at all.
void add_at_most(Section& section, std::string name, const Spread& measured, double limit,
                 std::string_view about);
void add_at_least(Section& section, std::string name, const Spread& measured, double limit,
                  std::string_view about);

/// The effort of a measurement. `quick`: all sections together take at most 3 minutes on 2 cores.
struct Effort {
  bool quick = false;
  std::function<void(std::string_view stage)> progress = [](std::string_view) {};
};

// The sections, in the order of the report.
Section tick_section(const Effort& effort);         ///< cost of a tick: N, rings touched, literal
Section engine_section(const Effort& effort);       ///< error against run time
Section convergence_section(const Effort& effort);  ///< convergence in ring height and rate
Section hands_section(const Effort& effort);        ///< pots thrown by simulated hands
Section left_out_section(const Effort& effort);  ///< the cost of each stage, included and left out
Section extremes_section(const Effort& effort);  ///< the suite of app/bench/extreme
Section servo_section(const Effort& effort);     ///< stable stiffness, closed loop
Section export_section(const Effort& effort);    ///< error and bytes against run time

}  // namespace clay::bench
