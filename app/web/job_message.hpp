#pragma once
// Questions of the window to the worker of the page, and its answers, as CBOR: every number arrives
// with the same bits.

#include "app/studio/export_choices.hpp"
#include "app/studio/guide/lesson.hpp"
#include "app/studio/readings/pot_check.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::web {

struct ExportQuestion {
  studio::ExportKind kind = studio::ExportKind::preview;
  studio::ExportChoices choices;
  Pot pot;
};
/// The files go beside the message, without a way through the memory of the window.
using ExportAnswer = Result<studio::ExportFigures>;

[[nodiscard]] std::string message_of(const studio::PotQuestion& question);
[[nodiscard]] std::string message_of(const ExportQuestion& question);
[[nodiscard]] std::string message_of(const studio::LessonQuestion& question);
/// One of the three; all empty for a message of another version of the page.
struct Question {
  std::optional<studio::PotQuestion> check;
  std::optional<ExportQuestion> exporting;
  std::optional<studio::LessonQuestion> lesson;
};
[[nodiscard]] Question question_in(std::string_view message);

[[nodiscard]] std::string message_of(const studio::PotCheck& check);
[[nodiscard]] std::string message_of(const ExportAnswer& answer);
[[nodiscard]] std::string message_of(const studio::LessonPlan& plan);
[[nodiscard]] std::optional<studio::PotCheck> check_in(std::string_view message);
[[nodiscard]] std::optional<ExportAnswer> export_in(std::string_view message);
[[nodiscard]] std::optional<studio::LessonPlan> plan_in(std::string_view message);

}  // namespace clay::web
