// One step computed again, very many steps, and the same steps twice.

#include "claystack/engine/wheel.hpp"
#include "extreme/hand.hpp"
#include "extreme/one_step.hpp"
#include "extreme/trial.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstring>
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
  Exact worst = 0;  ///< clay missing or too much, mm^2, whenever it was weighed
  Exact before = 0;
  std::string fault;
};

/// Force and flags of every tick go into the hash, the clay ten thousand times and at the end.
Played play(Who who, std::size_t ticks, std::uint64_t seed) {
  SceneSpec scene = small_pot();
  scene.force->friction = 0.2;
  const auto subject = std::move(put_on_wheel(who, scene).value());
  Played played;
  played.before = subject->clay().value();
  Hand hand(seed);
  Hash hash;
  for (std::size_t k = 1; k <= ticks && played.fault.empty(); ++k) {
    const Tick tick = subject->step(hand.next());
    played.contacts += tick.contact;
    hash.add(tick.force_n);
    hash.add(tick.contact);
    if (k % (1 + ticks / 10'000) != 0 && k != ticks) continue;
    played.fault = subject->fault();
    const auto clay = subject->clay();
    if (!clay) break;
    played.worst = std::max(played.worst, Exact(abs(*clay - played.before)));
    if (who == Who::literal && played.worst > played.before / 1'000'000'000)
      played.fault = fmt::format("clay off by {:.3g} % after {} ticks",
                                 Exact(100 * played.worst / played.before).convert_to<double>(), k);
    hash.add(subject->bytes());
  }
  played.hash = hash.value();
  return played;
}

Outcome drift(Who who) {
  const std::size_t ticks = who == Who::conserving ? drift_ticks.load() : 100'000;
  Played first, second;
  std::thread other([&] { second = play(who, ticks, 7); });
  first = play(who, ticks, 7);
  other.join();
  if (!first.fault.empty()) return {Verdict::failed, first.fault};
  if (first.worst != 0 && who == Who::conserving) return {Verdict::failed, "quanta lost"};
  if (first.hash != second.hash) return {Verdict::failed, "two runs differ"};
  if (first.contacts < ticks / 4) return {Verdict::failed, "too little contact"};
  return {Verdict::passed, fmt::format("{} ticks twice, {} in contact, 0 quanta, hash {:016x}",
                                       ticks, first.contacts, first.hash)};
}

/// Pots thrown side by side give what they give alone.
Outcome many_threads(Who who) {
  constexpr std::size_t kTicks = 2'000;
  std::vector<std::uint64_t> alone, together(4);
  for (std::uint64_t seed = 1; seed <= together.size(); ++seed)
    alone.push_back(play(who, kTicks, seed).hash);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < together.size(); ++k)
    threads.emplace_back([&, k] { together[k] = play(who, kTicks, k + 1).hash; });
  for (std::thread& thread : threads) thread.join();
  if (together != alone) return {Verdict::failed, "another pot beside it changes a pot"};
  return {Verdict::passed, fmt::format("4 threads, {} ticks each", kTicks)};
}

constexpr Case kCases[] = {
    {"one_step_again", "random ticks, pots, tools and kernels", "each ring within the bound",
     "removal and shares in 50 digits", Verdict::passed, one_step_again},
    {"drift", "10^6 ticks of a restless hand (10^7 in the full run)",
     "clay kept; the same hash twice", "exact rationals, hash", Verdict::failed, drift},
    {"many_threads", "four pots at once", "the same hashes as alone", "hash", Verdict::passed,
     many_threads},
};

}  // namespace

void set_drift_ticks(std::size_t ticks) { drift_ticks = ticks; }

std::span<const Case> step_cases() { return kCases; }

}  // namespace clay::extreme
