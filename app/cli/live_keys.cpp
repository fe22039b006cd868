#include "app/cli/live_keys.hpp"

#include "app/servo/signals.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <thread>

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
  if (!on_) return std::this_thread::sleep_for(time);
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, static_cast<int>(time.count())) <= 0) return;
  char key = 0;
  if (read(STDIN_FILENO, &key, 1) == 1) return press(key, live);
  std::this_thread::sleep_for(time);  // the terminal was closed
}

void LiveKeys::press(char key, servo::LiveThrow& live) {
  using servo::CommandKind;
  switch (key) {
    case ' ':
      paused_ = !paused_;
      live.command({CommandKind::pause, paused_ ? 1.0 : 0.0});
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
