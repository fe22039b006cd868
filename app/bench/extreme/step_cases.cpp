// One step recomputed, very many steps, and repeated runs.

#include "app/bench/extreme/hand.hpp"
#include "app/bench/extreme/one_step.hpp"
#include "app/bench/extreme/trial.hpp"
#include "claystack/engine/wheel.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

namespace clay::extreme {
namespace {

std::atomic<std::size_t> drift_ticks{1'000'000};

/// FNV-1a over bytes.
class Hash {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    for (const unsigned char byte : bytes) state_ = (state_ ^ byte) * 0x100000001b3u;
  }
  void add(const std::string& bytes) {
    for (const char byte : bytes) add(byte);
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

struct Played {
  std::uint64_t hash = 0;
  std::size_t contacts = 0;
  Exact worst = 0;  ///< largest volume error, mm^2, at any check
  std::string fault;
};

/// Plays random strokes on a pot. Hashes force and contact of every tick; checks the volume ten
/// thousand times and at the end.
class Player {
 public:
  Player(Model model, std::size_t ticks, std::uint64_t seed)
      : model_(model), ticks_(ticks), hand_(seed) {
    SceneSpec scene = small_pot();
    scene.force->friction = 0.2;
    subject_ = std::move(make_subject(model, scene).value());
    before_ = subject_->clay().value();
  }

  /// False once all ticks are played or the clay has a fault.
  bool tick() {
    if (tick_ == ticks_ || !played_.fault.empty()) return false;
    ++tick_;
    const Tick tick = subject_->step(hand_.next());
    played_.contacts += tick.contact;
    hash_.add(tick.force_n);
    hash_.add(tick.contact);
    if (tick_ % (1 + ticks_ / 10'000) == 0 || tick_ == ticks_) weigh();
    played_.hash = hash_.value();
    return true;
  }
  [[nodiscard]] const Played& played() const { return played_; }

 private:
  void weigh() {
    hash_.add(subject_->bytes());
    played_.fault = subject_->fault();
    const auto clay = subject_->clay();
    if (!clay) return;
    played_.worst = std::max(played_.worst, Exact(abs(*clay - before_)));
    if (model_ == Model::literal && played_.worst > before_ / 1'000'000'000)
      played_.fault = fmt::format("clay off by {:.3g} % after {} ticks",
                                  Exact(100 * played_.worst / before_).convert_to<double>(), tick_);
  }

  Model model_;
  std::size_t ticks_, tick_ = 0;
  Hand hand_;
  std::unique_ptr<Subject> subject_;
  Exact before_ = 0;
  Hash hash_;
  Played played_;
};

Played play(Model model, std::size_t ticks, std::uint64_t seed) {
  Player player(model, ticks, seed);
  while (player.tick()) {
  }
  return player.played();
}

Outcome drift(Model model) {
  const std::size_t ticks = model == Model::conserving ? drift_ticks.load() : 100'000;
  Played first, second;
  std::thread other([&] { second = play(model, ticks, 7); });
  first = play(model, ticks, 7);
  other.join();
  if (!first.fault.empty()) return {Verdict::failed, first.fault};
  if (first.worst != 0 && model == Model::conserving) return {Verdict::failed, "quanta lost"};
  if (first.hash != second.hash) return {Verdict::failed, "two runs differ"};
  if (first.contacts < ticks / 10) return {Verdict::failed, "too little contact"};
  return {Verdict::passed, fmt::format("{} ticks twice, {} in contact, 0 quanta, hash {:016x}",
                                       ticks, first.contacts, first.hash)};
}

/// Pots thrown in parallel, tick by tick in turn and in separate threads, give the same results as
/// alone.
Outcome side_by_side(Model model) {
  constexpr std::size_t kTicks = 2'000, kPots = 4;
  std::vector<std::uint64_t> alone, in_turn, in_threads(kPots);
  std::vector<Player> players;
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < kPots; ++k) {
    alone.push_back(play(model, kTicks, k + 1).hash);
    players.emplace_back(model, kTicks, k + 1);
    threads.emplace_back([&, k] { in_threads[k] = play(model, kTicks, k + 1).hash; });
  }
  for (std::size_t tick = 0; tick < kTicks; ++tick)
    for (Player& player : players) player.tick();
  for (std::thread& thread : threads) thread.join();
  for (const Player& player : players) in_turn.push_back(player.played().hash);
  if (in_turn != alone || in_threads != alone)
    return {Verdict::failed, "a pot changes if another is thrown at the same time"};
  return {Verdict::passed, fmt::format("{} pots, {} ticks each", kPots, kTicks)};
}

constexpr Case kStepCases[] = {
    {"one_step_again", "random ticks, pots, tools and kernels", "each ring within the bound",
     "removal and shares in 50 digits", Verdict::passed, one_step_again},
    {"drift", "10^6 ticks of an erratic hand (10^7 in the full run)",
     "clay conserved; the same hash twice", "exact rationals, hash", Verdict::failed, drift},
    {"side_by_side", "four pots, in turn and in threads", "the same hashes as alone", "hash",
     Verdict::passed, side_by_side},
};

}  // namespace

void set_drift_ticks(std::size_t ticks) { drift_ticks = ticks; }

std::span<const Case> step_cases() { return kStepCases; }

}  // namespace clay::extreme
