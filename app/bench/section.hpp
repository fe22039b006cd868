#pragma once
// What a measurement has to say, apart from how it is shown: numbers, tables and plots. One
// writer each turns them into text, JSON, CSV and HTML.

#include "app/chart/plot.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clay::bench {

/// A measured number: median of the repetitions, and how far the middle half of them spreads.
struct Value {
  std::string name;  ///< key in JSON, with its unit: n200_ns
  double median = 0.0;
  double spread = 0.0;  ///< interquartile range; 0 for what is counted, not timed: then not told
  std::string about;    ///< for people
};

/// Nothing, a verdict, a count, a number, or words.
using Cell = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct Column {
  std::string name;  ///< key in JSON
  std::string unit;  ///< empty where there is none
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
  std::string id;  ///< the word after --only
  std::string title;
  std::string summary;  ///< what was asked, how it was measured, what came out
  std::vector<Value> values;
  std::vector<Table> tables;
  std::vector<Plot> plots;
  std::vector<Map> maps;
  bool sound = true;  ///< false when something that must hold did not
};

/// How much time to spend. `quick`: all sections together within 3 minutes on 2 cores.
struct Effort {
  bool quick = false;
  std::function<void(std::string_view stage)> progress = [](std::string_view) {};
};

// The sections, in the order of the report.
Section tick_section(const Effort& effort);         ///< cost of a tick: N, rings touched, literal
Section engine_section(const Effort& effort);       ///< error against run time
Section convergence_section(const Effort& effort);  ///< h -> 0 and rate -> infinity
Section left_out_section(const Effort& effort);     ///< what each stage costs in, and out
Section extremes_section(const Effort& effort);     ///< the suite of tests/extreme
Section servo_section(const Effort& effort);        ///< stable stiffness, stiff closed loop
Section export_section(const Effort& effort);       ///< error and bytes against run time

}  // namespace clay::bench
