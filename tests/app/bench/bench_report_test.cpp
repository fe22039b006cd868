// The writers of reports and their basis, compared with known figures and an XML parser.

#include "app/bench/registered_sections.hpp"
#include "app/bench/report/report.hpp"
#include "app/bench/statistics.hpp"
#include "app/bench/timing.hpp"
#include "app/chart/axis_scale.hpp"
#include "core/svg_writer.hpp"
#include "tests/support/run_program.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clay::test {
namespace {

using namespace bench;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kHostile = "</td><script>alert(1)</script>\"'& \x01\xff\xC0\x80 end]]>";

/// A report with a value of every kind, including unusual ones.
Report odd_report() {
  Section section;
  section.id = "odd";
  section.title = kHostile;
  section.summary = kHostile;
  section.values = {
      {"time_ns", 12.5, 0.25, kHostile}, {"count", 3.0, 0.0, ""}, {"none", kNan, 0.0, ""}};
  section.tables = {{"odd_table",
                     kHostile,
                     {{"case", ""}, {"pass", ""}, {"error_mm", "mm"}, {"n", ""}},
                     {{kHostile, true, 0.1, std::int64_t{9007199254740993}},
                      {std::string("a,b\"c\r\nd"), false, kNan, std::monostate{}}},
                     kHostile}};
  Plot plot{"odd_plot", kHostile, {kHostile, true}, {kHostile, true}, {}, kHostile};
  plot.curves.push_back({"", {}, {}, {}, {}});
  plot.curves.push_back(
      {kHostile, {1.0, 0.0, 10.0, kNan, 1e300}, {0.0, 1.0, -1.0, 2.0, kInfinity}, {}, {}});
  Curve& spread =
      plot.curves.emplace_back(Curve{"spread", {1.0, 10.0}, {2.0, 3.0}, {1.5, kNan}, {2.5, 4.0}});
  spread.x_low = {0.5, 9.0};
  spread.x_high = {1.5, 11.0};
  spread.labels = {"N 1, fine", "N 10"};
  section.plots = {plot, {"empty_plot", "empty", {"x", false}, {"y", false}, {}, ""}};
  Map map{"odd_map", kHostile,    {"x", true}, {"y", false}, {1.0, 10.0}, {0.0, 1.0},
          {},        plot.curves, ""};
  map.cells = {{0.0, 0.5}, {kNan, 7.0}};
  section.maps = {map, {"empty_map", "", {"x", false}, {"y", false}, {}, {}, {}, {}, ""}};
  return {{kHostile, 2, "s", "c", "f", "v"}, kHostile, {section}};
}

/// The result of xmllint for a document.
Ran parsed(const std::string& text) {
  const ScratchFolder folder;
  write_text(folder.file("page.xml"), text);
  return shell("xmllint --noout --nonet " + folder.file("page.xml"));
}

TEST(BenchStatistics, ReturnsQuartilesOfKnownSamples) {
  // Definition 7: at (n - 1) p. For 1..5 these are the 2nd, 3rd, 4th; for 1..4 they lie between.
  const Spread five = spread_of({5.0, 1.0, 4.0, 2.0, 3.0});
  EXPECT_EQ(five.low, 2.0);
  EXPECT_EQ(five.median, 3.0);
  EXPECT_EQ(five.high, 4.0);
  EXPECT_EQ(five.range(), 2.0);
  const Spread four = spread_of({4.0, 3.0, 2.0, 1.0});
  EXPECT_EQ(four.low, 1.75);
  EXPECT_EQ(four.median, 2.5);
  EXPECT_EQ(four.high, 3.25);
  EXPECT_EQ(quantile({7.0}, 0.9), 7.0);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
  EXPECT_EQ(ratio_of({2.0, 9.0, 8.0}, {1.0, 3.0, 2.0}).median, 3.0);
}

RC_GTEST_PROP(BenchStatistics, QuantileLiesBetweenNeighbouringOrderStatistics, ()) {
  auto samples = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(
      rc::gen::map(rc::gen::inRange(-1000, 1000), [](int k) { return 0.125 * k; })));
  const double fraction = 0.001 * *rc::gen::inRange(0, 1001);
  const double value = quantile(samples, fraction);
  std::ranges::sort(samples);
  const double at = fraction * static_cast<double>(samples.size() - 1);
  RC_ASSERT(samples[static_cast<std::size_t>(std::floor(at))] <= value);
  RC_ASSERT(value <= samples[static_cast<std::size_t>(std::ceil(at))]);
}

TEST(BenchSection, MissesABoundOnlyIfThreeQuartersOfTheRepetitionsDo) {
  const Spread noisy{0.9, 1.1, 1.2};
  Section section;
  add_at_most(section, "a", noisy, 1.0, "ratio");
  add_at_least(section, "b", noisy, 1.15, "ratio");
  EXPECT_TRUE(section.sound());
  add_at_most(section, "c", noisy, 0.8, "ratio");
  add_at_least(section, "d", noisy, 1.3, "ratio");
  add_at_most(section, "e", counted(kNan), 1.0, "ratio");
  EXPECT_EQ(section.missed, (std::vector<std::string>{"c: required at most 0.8, measured 1.1",
                                                      "d: required at least 1.3, measured 1.1",
                                                      "e: required at most 1, measured –"}));
  EXPECT_EQ(section.values.size(), 5U);
  EXPECT_EQ(section.values[0].about, "ratio; required: at most 1");
}

TEST(BenchReport, NamesTheBoundsThatDoNotHold) {
  Report report = odd_report();
  EXPECT_TRUE(report.sound());
  report.sections.front().require(false, "count: required at most 2, measured 3");
  EXPECT_FALSE(report.sound());
  const std::string missed = "count: required at most 2, measured 3";
  EXPECT_NE(text_of(report.sections.front()).find(missed), std::string::npos);
  EXPECT_NE(html_of(report).find(missed), std::string::npos);
  EXPECT_EQ(json_of(report).at("sections").at(0).at("missed").at(0), missed);
}

TEST(BenchTiming, RunsEveryWorkloadEveryRoundAndAveragesRepetitions) {
  std::vector<int> calls(2);
  const std::vector<Work> works{{"a", [&] { return ++calls[0], 1e-3; }},
                                {"b", [&] { return ++calls[1], 2e-3; }}};
  const auto samples = time_rounds(works, {7, 4e-3});
  ASSERT_EQ(samples.size(), 2u);
  for (const double s : samples[0]) EXPECT_NEAR(s, 1e-3, 1e-12);
  for (const double s : samples[1]) EXPECT_NEAR(s, 2e-3, 1e-12);
  EXPECT_EQ(samples[0].size(), 7u);
  EXPECT_EQ(samples[1].size(), 7u);
  EXPECT_GE(calls[0], 8 * 4);
  EXPECT_EQ(duel(works[0], works[1], {3, 1e-3}).ratio.median, 2.0);
}

TEST(BenchTiming, StopsAndReportsAFailingWorkload) {
  const Work failing{"f", [] { return kNan; }}, sound{"s", [] { return 1e-3; }};
  const Duel d = duel(sound, failing, {3, 1e-3});
  EXPECT_NEAR(d.a.median, 1e-3, 1e-12);
  EXPECT_TRUE(std::isnan(d.b.median));
}

TEST(BenchSections, ListsTheSectionsForAnUnknownName) {
  const auto chosen = chosen_sections({"tick", "pots"});
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().kind, ErrorKind::bad_input);
  for (const auto& section : registered_sections())
    EXPECT_NE(chosen.error().message.find(section.id), std::string::npos);
  EXPECT_NE(chosen.error().message.find("found pots"), std::string::npos);
}

TEST(BenchSections, RunInReportOrder) {
  const auto chosen = chosen_sections({"left_out", "tick"});
  ASSERT_TRUE(chosen);
  ASSERT_EQ(chosen->size(), 2u);
  EXPECT_EQ(chosen->front().id, "tick");
  EXPECT_EQ(chosen_sections({})->size(), registered_sections().size());
}

TEST(BenchJson, StoresEveryPartUnderItsId) {
  const auto json = json_of(odd_report());
  EXPECT_EQ(json.at("odd").at("time_ns"), 12.5);
  EXPECT_EQ(json.at("odd").at("time_ns_iqr"), 0.25);
  EXPECT_FALSE(json.at("odd").contains("count_iqr"));
  EXPECT_EQ(json.at("odd_table").size(), 2u);
  EXPECT_EQ(json.at("odd_table")[0].at("n"), 9007199254740993);
  EXPECT_EQ(json.at("odd_table")[0].at("pass"), true);
  EXPECT_TRUE(json.at("odd_table")[1].at("n").is_null());
  EXPECT_EQ(json.at("odd_plot").at("curves").size(), 3u);
  const auto& spread = json.at("odd_plot").at("curves")[2];
  EXPECT_EQ(spread.at("low")[0], 1.5);
  EXPECT_EQ(spread.at("x_low")[1], 9.0);
  EXPECT_EQ(spread.at("x_high")[1], 11.0);
  EXPECT_EQ(spread.at("labels")[0], "N 1, fine");
  EXPECT_FALSE(json.at("odd_plot").at("curves")[1].contains("x_low"));
  EXPECT_EQ(json.at("odd_map").at("cells")[0][1], 0.5);
  EXPECT_EQ(json.at("sections")[0].at("tables")[0].at("units").at("error_mm"), "mm");
  EXPECT_EQ(json.at("machine").at("cores"), 2);
  // The text parses again, with null for missing numbers.
  const auto again =
      nlohmann::json::parse(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  EXPECT_TRUE(again.at("odd").at("none").is_null());
  EXPECT_TRUE(again.at("odd_table")[1].at("error_mm").is_null());
  EXPECT_TRUE(again.at("odd_map").at("cells")[1][0].is_null());
}

TEST(BenchJson, DescribesEachValueWithItsRequiredBound) {
  Report report = odd_report();
  add_at_most(report.sections[0], "ratio", counted(0.5), 1.5, "a ratio");
  const auto json = json_of(report);
  const auto& values = json.at("sections")[0].at("values");
  EXPECT_EQ(values.at("time_ns"), kHostile);
  EXPECT_EQ(values.at("ratio"), "a ratio; required: at most 1.5");
}

TEST(BenchText, AlignsAHeadingWithNumbersBelowAMissingCell) {
  Section section;
  section.tables = {{"t", "", {{"name", ""}, {"n", ""}}, {{"a", {}}, {"b", 12345.0}}, ""}};
  EXPECT_NE(text_of(section).find("      n\n"), std::string::npos) << text_of(section);
}

TEST(BenchJson, PutsTheTableNamedLikeTheSectionFirst) {
  Report report = odd_report();
  report.sections[0].tables[0].id = "odd";
  const auto json = json_of(report);
  EXPECT_TRUE(json.at("odd").is_array());
  EXPECT_EQ(json.at("odd_values").at("count"), 3.0);
}

/// RFC 4180, written from the standard: fields of records.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> records;
  std::vector<std::string> fields{""};
  bool in_quotes = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (in_quotes) {
      if (text[k] != '"')
        fields.back() += text[k];
      else if (k + 1 < text.size() && text[k + 1] == '"')
        fields.back() += text[++k];
      else
        in_quotes = false;
    } else if (text[k] == '"') {
      in_quotes = true;
    } else if (text[k] == ',') {
      fields.emplace_back();
    } else if (text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n') {
      ++k;
      records.push_back(fields);
      fields = {""};
    } else {
      fields.back() += text[k];
    }
  }
  return records;
}

std::string csv_named(const Report& report, const std::string& name) {
  for (const auto& [file, text] : csv_files(report))
    if (file == name) return text;
  return "no file " + name;
}

TEST(BenchCsv, WritesTheSpreadOfBothAxesAndTheLabels) {
  const auto records = parse_csv(csv_named(odd_report(), "odd_plot.csv"));
  ASSERT_EQ(records.size(), 8u);  // names, five points of a curve, two of another
  EXPECT_EQ(records[0], (std::vector<std::string>{"curve", "x", "y", "low", "high", "x_low",
                                                  "x_high", "label"}));
  EXPECT_EQ(records[6], (std::vector<std::string>{"spread", "1", "2", "1.5", "2.5", "0.5", "1.5",
                                                  "N 1, fine"}));
  EXPECT_EQ(records[7],
            (std::vector<std::string>{"spread", "10", "3", "", "4", "9", "11", "N 10"}));
}

TEST(BenchCsv, RoundTripsTables) {
  const auto records = parse_csv(csv_named(odd_report(), "odd_table.csv"));
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records[0], (std::vector<std::string>{"case", "pass", "error_mm", "n"}));
  EXPECT_EQ(records[1], (std::vector<std::string>{kHostile, "true", "0.1", "9007199254740993"}));
  EXPECT_EQ(records[2], (std::vector<std::string>{"a,b\"c\r\nd", "false", "", ""}));
  const auto map = parse_csv(csv_named(odd_report(), "odd_map.csv"));
  ASSERT_EQ(map.size(), 5u);
  EXPECT_EQ(map[2], (std::vector<std::string>{"10", "0", "0.5"}));
}

RC_GTEST_PROP(BenchCsv, RoundTripsNumbersAndTextExactly,
              (std::vector<std::pair<double, std::string>> rows)) {
  Report report;
  Table table{"t", "", {{"number", ""}, {"text", ""}}, {}, ""};
  for (const auto& [number, text] : rows) table.rows.push_back({number, text});
  report.sections.emplace_back().tables.push_back(table);
  const auto records = parse_csv(csv_named(report, "t.csv"));
  RC_ASSERT(records.size() == rows.size() + 1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    RC_ASSERT(std::stod(records[k + 1][0]) == rows[k].first);
    RC_ASSERT(records[k + 1][1] == rows[k].second);
  }
}

TEST(BenchCsv, KeepsFilesOfAnyIdInTheFolder) {
  Report report = odd_report();
  report.sections[0].tables[0].id = "../../etc/a b";
  bool found = false;
  for (const auto& [file, text] : csv_files(report)) {
    EXPECT_EQ(file.find('/'), std::string::npos);
    found = found || file == "______etc_a_b.csv";
  }
  EXPECT_TRUE(found);
}

TEST(BenchHtml, IsWellFormedForAnyNames) {
  const std::string html = html_of(odd_report());
  const auto run = parsed(html);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(html.find("<script"), std::string::npos);
  for (const char* outside : {"http://", "https://", "src=", "@import", "url("}) {
    std::string rest = html;
    // The namespaces of the two languages are not fetched.
    for (const std::string name : {"http://www.w3.org/1999/xhtml", "http://www.w3.org/2000/svg"})
      for (auto at = rest.find(name); at != std::string::npos; at = rest.find(name))
        rest.erase(at, name.size());
    EXPECT_EQ(rest.find(outside), std::string::npos) << outside;
  }
  for (const char* number : {"nan", "inf"})
    EXPECT_EQ(html.find(std::string("=\"") + number), std::string::npos);
  EXPECT_EQ(html, html_of(odd_report()));
}

TEST(BenchHtml, IsWellFormedForASingleDrawing) {
  const Report report = odd_report();
  for (const Plot& plot : report.sections[0].plots)
    EXPECT_EQ(parsed(svg_of(plot, chart::Place::alone)).status, 0) << plot.id;
  for (const Map& map : report.sections[0].maps)
    EXPECT_EQ(parsed(svg_of(map, chart::Place::alone)).status, 0) << map.id;
}

}  // namespace
}  // namespace clay::test
