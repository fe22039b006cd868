#include "app/web/job_message.hpp"

#include "claystack/engine/files.hpp"

#include <nlohmann/json.hpp>

#include <memory>
#include <utility>

namespace clay::web {
namespace {

using nlohmann::json;
using studio::ExportChoices;
using studio::ExportFigures;
using studio::PotCheck;
using studio::PotQuestion;

json binary(std::string_view bytes) {
  return json::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}
std::string bytes_in(const json& value) {
  const auto& bytes = value.get_binary();
  return {bytes.begin(), bytes.end()};
}
std::string text_of(const json& value) {
  std::string text;
  json::to_cbor(value, text);
  return text;
}
json value_in(std::string_view message) { return json::from_cbor(message.begin(), message.end()); }

json json_of(const glm::dvec2& place) { return {place.x, place.y}; }
glm::dvec2 place_in(const json& value) { return {value[0].get<double>(), value[1].get<double>()}; }

json json_of(const std::optional<double>& number) { return number ? json(*number) : json(); }
std::optional<double> number_in(const json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

json pot_json(const Pot& pot) { return binary(write_pot(pot, PotEncoding::cbor)); }
Pot pot_in(const json& value) {
  return parse_pot(bytes_in(value), "the pot of the window").value();
}

json json_of(const ExportChoices& choices) {
  json meshes = json::array();
  for (const solid::MeshFormat format : choices.meshes) meshes.push_back(static_cast<int>(format));
  return {{"meshes", meshes},
          {"section", choices.section},
          {"pot", choices.pot},
          {"name", choices.name},
          {"tolerance_mm", choices.tolerance_mm},
          {"smoothing", static_cast<int>(choices.smoothing)},
          {"process", choices.process},
          {"min_wall_mm", choices.min_wall_mm},
          {"shrinkage_percent", choices.shrinkage_percent}};
}
ExportChoices choices_in(const json& value) {
  ExportChoices choices;
  choices.meshes.clear();
  for (const json& format : value["meshes"])
    choices.meshes.push_back(static_cast<solid::MeshFormat>(format.get<int>()));
  choices.section = value["section"];
  choices.pot = value["pot"];
  choices.name = value["name"];
  choices.tolerance_mm = value["tolerance_mm"];
  choices.smoothing = static_cast<solid::Smoothing>(value["smoothing"].get<int>());
  choices.process = value["process"];
  choices.min_wall_mm = value["min_wall_mm"];
  choices.shrinkage_percent = value["shrinkage_percent"];
  return choices;
}

json json_of(const Error& error) {
  return {{"kind", static_cast<int>(error.kind)}, {"message", error.message}};
}
Error error_in(const json& value) {
  return {static_cast<ErrorKind>(value["kind"].get<int>()), value["message"]};
}

json json_of(const ExportFigures& figures) {
  json meshes = json::array(), marks = json::array();
  for (const ExportFigures::Mesh& mesh : figures.meshes)
    meshes.push_back({static_cast<int>(mesh.format), mesh.bytes});
  for (const studio::Mark& mark : figures.marks)
    marks.push_back({json_of(mark.place_mm), mark.text});
  return {{"has_solid", figures.has_solid},
          {"triangles", figures.triangles},
          {"meshes", meshes},
          {"diameter_mm", figures.diameter_mm},
          {"height_mm", figures.height_mm},
          {"shrinkage", figures.shrinkage},
          {"fallen", figures.fallen},
          {"thinnest_mm", figures.thinnest_mm},
          {"thinnest_at_mm", figures.thinnest_at_mm},
          {"problems", figures.problems},
          {"marks", marks}};
}
ExportFigures figures_in(const json& value) {
  ExportFigures figures;
  figures.has_solid = value["has_solid"];
  figures.triangles = value["triangles"];
  for (const json& mesh : value["meshes"])
    figures.meshes.push_back({static_cast<solid::MeshFormat>(mesh[0].get<int>()), mesh[1]});
  figures.diameter_mm = value["diameter_mm"];
  figures.height_mm = value["height_mm"];
  figures.shrinkage = value["shrinkage"];
  figures.fallen = value["fallen"];
  figures.thinnest_mm = value["thinnest_mm"];
  figures.thinnest_at_mm = value["thinnest_at_mm"];
  figures.problems = value["problems"].get<std::vector<std::string>>();
  for (const json& mark : value["marks"]) figures.marks.push_back({place_in(mark[0]), mark[1]});
  return figures;
}

json json_of(const solid::Problem& problem) {
  return {{"text", problem.text},
          {"at", problem.at ? json{problem.at->rho, problem.at->y} : json()},
          {"fails", problem.fails},
          {"kind", static_cast<int>(problem.kind)},
          {"figure", problem.figure}};
}
solid::Problem problem_in(const json& value) {
  solid::Problem problem;
  problem.text = value["text"];
  if (const json& at = value["at"]; !at.is_null()) problem.at = {at[0], at[1]};
  problem.fails = value["fails"];
  problem.kind = static_cast<solid::ProblemKind>(value["kind"].get<int>());
  problem.figure = value["figure"];
  return problem;
}

json json_of(const solid::WallLimit& limit) {
  return {limit.up_to_size_sum_mm, limit.min_wall_mm, limit.source, limit.process};
}
solid::WallLimit limit_in(const json& value) { return {value[0], value[1], value[2], value[3]}; }

}  // namespace

std::string message_of(const PotQuestion& question) {
  json rows = json::array();
  for (const render::Row& row : question.subject.outline.rows)
    rows.insert(rows.end(), {row.outer_mm, row.inner_mm});
  const history::SharedPot& pot = question.subject.pot;
  return text_of({{"pot", pot ? pot_json(*pot) : json()},
                  {"rows", rows},
                  {"height_mm", question.subject.outline.height_mm},
                  {"density_g_cm3", question.subject.density_g_cm3},
                  {"crown_mm", question.subject.crown_mm},
                  {"process", question.process},
                  {"tolerance_mm", question.tolerance_mm}});
}

std::string message_of(const Pot& pot, const ExportChoices& choices, studio::ExportKind kind) {
  return text_of(
      {{"export", static_cast<int>(kind)}, {"choices", json_of(choices)}, {"pot", pot_json(pot)}});
}

Question question_in(std::string_view message) {
  const json value = value_in(message);
  Question question;
  if (value.contains("export")) {
    question.exporting = {static_cast<studio::ExportKind>(value["export"].get<int>()),
                          choices_in(value["choices"]), pot_in(value["pot"])};
    return question;
  }
  PotQuestion& check = question.check.emplace();
  if (const json& pot = value["pot"]; !pot.is_null())
    check.subject.pot = std::make_shared<const Pot>(pot_in(pot));
  const json& rows = value["rows"];
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    check.subject.outline.rows.push_back({rows[i], rows[i + 1]});
  check.subject.outline.height_mm = value["height_mm"];
  check.subject.density_g_cm3 = value["density_g_cm3"];
  check.subject.crown_mm = value["crown_mm"];
  check.process = value["process"];
  check.tolerance_mm = value["tolerance_mm"];
  return question;
}

std::string message_of(const PotCheck& check) {
  json remarks = json::array(), problems = json::array(), walls = json::array();
  for (const studio::PotRemark& remark : check.remarks)
    remarks.push_back({remark.from_mm, remark.to_mm, remark.text});
  for (const solid::Problem& problem : check.problems) problems.push_back(json_of(problem));
  for (const render::RowWall& wall : check.walls)
    walls.insert(walls.end(), {wall.outer_mm, wall.inner_mm});
  return text_of({{"live", check.live},
                  {"proved", check.proved},
                  {"why_not", check.why_not},
                  {"fault_mm", json_of(check.fault_mm)},
                  {"remarks", remarks},
                  {"fallen", check.fallen},
                  {"triangles", check.triangles},
                  {"tolerance_mm", check.tolerance_mm},
                  {"counted_mm3", check.counted_mm3},
                  {"proved_mm3", check.proved_mm3},
                  {"volume_error_relative", check.volume_error_relative},
                  {"least_wall_mm", check.least_wall_mm},
                  {"thinnest_mm", check.thinnest_mm},
                  {"thinnest_from", json_of(check.thinnest_from)},
                  {"thinnest_to", json_of(check.thinnest_to)},
                  {"limit", check.limit ? json_of(*check.limit) : json()},
                  {"problems", problems},
                  {"walls", walls},
                  {"height_mm", check.height_mm},
                  {"seconds", check.seconds}});
}

std::optional<PotCheck> check_in(std::string_view message) {
  const json value = value_in(message);
  if (!value.contains("proved")) return std::nullopt;
  PotCheck check;
  check.live = value["live"];
  check.proved = value["proved"];
  check.why_not = value["why_not"];
  check.fault_mm = number_in(value["fault_mm"]);
  for (const json& remark : value["remarks"])
    check.remarks.push_back({remark[0], remark[1], remark[2]});
  check.fallen = value["fallen"];
  check.triangles = value["triangles"];
  check.tolerance_mm = value["tolerance_mm"];
  check.counted_mm3 = value["counted_mm3"];
  check.proved_mm3 = value["proved_mm3"];
  check.volume_error_relative = value["volume_error_relative"];
  check.least_wall_mm = value["least_wall_mm"];
  check.thinnest_mm = value["thinnest_mm"];
  check.thinnest_from = place_in(value["thinnest_from"]);
  check.thinnest_to = place_in(value["thinnest_to"]);
  if (const json& limit = value["limit"]; !limit.is_null()) check.limit = limit_in(limit);
  for (const json& problem : value["problems"]) check.problems.push_back(problem_in(problem));
  const json& walls = value["walls"];
  for (std::size_t i = 0; i + 1 < walls.size(); i += 2)
    check.walls.push_back({walls[i], walls[i + 1]});
  check.height_mm = value["height_mm"];
  check.seconds = value["seconds"];
  return check;
}

std::string message_of(const ExportAnswer& answer) {
  json files = json::array();
  for (const std::string& file : answer.files) files.push_back(binary(file));
  return text_of({{"files", files},
                  {"done", answer.done ? json_of(*answer.done) : json()},
                  {"error", answer.done ? json() : json_of(answer.done.error())}});
}

std::optional<ExportAnswer> export_in(std::string_view message) {
  const json value = value_in(message);
  if (!value.contains("files")) return std::nullopt;
  const json& done = value["done"];
  ExportAnswer answer{done.is_null()
                          ? Result<ExportFigures>(tl::make_unexpected(error_in(value["error"])))
                          : Result<ExportFigures>(figures_in(done)),
                      {}};
  for (const json& file : value["files"]) answer.files.push_back(bytes_in(file));
  return answer;
}

}  // namespace clay::web
