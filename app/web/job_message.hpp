#pragma once
// Questions of the window to the worker of the page, and its answers, as CBOR: every number arrives
// with the same bits.

#include "app/studio/export_choices.hpp"
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
struct ExportAnswer {
  Result<studio::ExportFigures> done;
  std::vector<std::string> files;  ///< contents, in the order of studio::paths_of
};

[[nodiscard]] std::string message_of(const studio::PotQuestion& question);
[[nodiscard]] std::string message_of(const ExportQuestion& question);
/// One of the two; both empty for a message of another version of the page.
struct Question {
  std::optional<studio::PotQuestion> check;
  std::optional<ExportQuestion> exporting;
};
[[nodiscard]] Question question_in(std::string_view message);

[[nodiscard]] std::string message_of(const studio::PotCheck& check);
[[nodiscard]] std::string message_of(const ExportAnswer& answer);
[[nodiscard]] std::optional<studio::PotCheck> check_in(std::string_view message);
[[nodiscard]] std::optional<ExportAnswer> export_in(std::string_view message);

}  // namespace clay::web
