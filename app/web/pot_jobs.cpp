// The worker's side of the page: answers the questions of the window. It is part of the module of
// the program claystack, whose commands the page runs as well.

#include "app/web/job_message.hpp"

#include <emscripten.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace clay::web {
namespace {

EM_JS(void, show_stage, (const char* text, int size), {
  if (Module["onStage"]) Module["onStage"](UTF8ToString(text, size));
});

/// Leaves the files in the folder `/exported`, where worker.js takes them.
ExportAnswer run(ExportQuestion question) {
  namespace fs = std::filesystem;
  const fs::path folder = "/exported";
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  fs::create_directory(folder, ignored);
  question.choices.folder = folder.string();
  cli::Thumbnail thumbnail;
  return studio::run_export(
      question.pot, question.choices, question.kind, thumbnail, [] { return false; },
      [](std::string_view stage) { show_stage(stage.data(), static_cast<int>(stage.size())); });
}

std::string answer_to(std::string_view message) {
  Question question = question_in(message);
  if (question.check) return message_of(check_pot(*question.check));
  if (question.lesson) return message_of(plan_step(*question.lesson));
  if (question.exporting) return message_of(run(std::move(*question.exporting)));
  return {};  // another version of the page asked
}

}  // namespace
}  // namespace clay::web

extern "C" {
/// Answers a message. The answer is valid until the next call; claystack_answer_bytes is its size.
EMSCRIPTEN_KEEPALIVE const char* claystack_answer(const char* message, int size);
EMSCRIPTEN_KEEPALIVE int claystack_answer_bytes();
}

namespace {
std::string answer;
}

const char* claystack_answer(const char* message, int size) {
  answer = clay::web::answer_to({message, static_cast<std::size_t>(size)});
  return answer.data();
}

int claystack_answer_bytes() { return static_cast<int>(answer.size()); }
