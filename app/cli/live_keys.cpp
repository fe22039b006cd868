#include "app/cli/live_keys.hpp"

#include "app/servo/signals.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <thread>
#include <utility>

namespace clay::cli {
namespace {

// Static, and set before signal handlers are installed: a handler restores it.
termios before{};

void put_back() noexcept { tcsetattr(STDIN_FILENO, TCSANOW, &before); }

/// A background process does not own the terminal.
bool is_ours() {
  return isatty(STDIN_FILENO) == 1 && tcgetpgrp(STDIN_FILENO) == getpgrp() &&
         tcgetattr(STDIN_FILENO, &before) == 0;
}

}  // namespace

LiveKeys::LiveKeys() : on_(is_ours()) {
  if (!on_) return;
  servo::ForceSignals::at_the_end(put_back);
  termios raw = before;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);  // Ctrl-C and Ctrl-\ still send signals
  raw.c_cc[VMIN] = raw.c_cc[VTIME] = 0;
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

LiveKeys::~LiveKeys() {
  if (!on_) return;
  // Discards unread keys, so that the shell does not get them.
  tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
  servo::ForceSignals::at_the_end(nullptr);
}

void LiveKeys::serve(servo::LiveThrow& live, std::chrono::milliseconds time) {
  for (const char key : std::exchange(kept_, {})) press(key, live);
  const auto key = key_within(time);
  if (!key) return;
  // A servo that has just ended takes no commands; the next one may.
  if (live.running())
    press(*key, live);
  else
    kept_ += *key;
}

bool LiveKeys::wait(std::chrono::milliseconds time) {
  if (kept_.find('q') != std::string::npos) return false;
  const auto key = key_within(time);
  if (key == 'q') return false;
  if (key) kept_ += *key;
  return true;
}

std::optional<char> LiveKeys::key_within(std::chrono::milliseconds time) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (on_ && poll(&input, 1, static_cast<int>(time.count())) <= 0) return std::nullopt;
  char key = 0;
  if (on_ && read(STDIN_FILENO, &key, 1) == 1) return key;
  std::this_thread::sleep_for(time);  // no terminal, or it was closed
  return std::nullopt;
}

void LiveKeys::press(char key, servo::LiveThrow& live) {
  using servo::CommandKind;
  switch (key) {
    case ' ':
      live.command({CommandKind::pause, live.status().paused ? 0.0 : 1.0});
      break;
    case 'z':
      live.command({CommandKind::zero, 0.0});
      break;
    case 'r':
      live.command({CommandKind::rearm, 0.0});
      break;
    case 'q':
      live.command({CommandKind::stop, 0.0});
      break;
    default:
      break;
  }
}

}  // namespace clay::cli
