#pragma once
// Which bodies of a crowd may meet: a sieve that leaves few pairs for exact tests, also where long
// thin bodies lie aslant, side by side, and boxes along the axes say nothing.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace clay::solid {

inline constexpr std::uint32_t kNoHub = UINT32_MAX;

/// The convex hull of its corners, thickened by the slack.
struct Body {
  std::array<glm::dvec3, 4> corners;                          ///< finite, any unit
  double slack = 0.0;                                         ///< at least 0, unit of the corners
  std::array<std::uint32_t, 3> hubs{kNoHub, kNoHub, kNoHub};  ///< crowded places it hangs from
  std::uint32_t number = 0;                                   ///< the caller's
  bool early = false;                                         ///< the caller's
};

/// Every pair of bodies that may meet and share no hub, each once. Never leaves out a pair that
/// meets: a pair is dropped only where a plane lies between them beyond the rounding error.
///
/// Halves the crowd again and again by where its bodies are; of two halves only those stay that
/// reach into the box of the other half, or past the plane between two bundles of long bodies.
/// Bodies about one hub cannot be told apart like that, so such pairs are the caller's.
class NearPairs {
 public:
  explicit NearPairs(std::vector<Body> bodies);

  /// visit(a, b): positions of two bodies; false ends the search.
  template <class Visit>
  void for_each(const Visit& visit) {
    search({this, &visit, [](const void* on, std::uint32_t a, std::uint32_t b) {
              return (*static_cast<const Visit*>(on))(a, b);
            }});
  }

  [[nodiscard]] const Body& operator[](std::uint32_t i) const { return bodies_[i]; }

 private:
  using Positions = std::vector<std::uint32_t>;
  struct Box {
    glm::dvec3 low, high;
  };
  struct Visitor {
    NearPairs* pairs;
    const void* visit;
    bool (*call)(const void*, std::uint32_t, std::uint32_t);
  };

  void search(const Visitor& visitor);
  void arrange();
  void within(std::size_t begin, std::size_t end);
  void between(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);
  void halves_between(Positions& cut, const Positions& whole);
  bool without_hub(const Positions& a, const Positions& b);
  void sieve_by_boxes(Positions& a, Positions& b) const;
  void sieve_by_planes(Positions& a, Positions& b) const;
  void sieve_along(const glm::dvec3& direction, Positions& a, Positions& b) const;
  void offer(std::uint32_t a, std::uint32_t b);

  [[nodiscard]] Box box_of(std::span<const std::uint32_t> all) const;
  [[nodiscard]] glm::dvec3 middle_of(const Positions& all) const;
  [[nodiscard]] glm::dvec3 grain_of(const Positions& all, const glm::dvec3& like) const;
  [[nodiscard]] std::uint32_t common_hub(const Positions& a, const Positions& b) const;
  [[nodiscard]] std::size_t halve(std::span<std::uint32_t> all) const;
  [[nodiscard]] bool share_hub(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool hangs_from(std::uint32_t body, std::uint32_t hub) const;

  std::vector<Body> bodies_;  ///< corners from the middle of all
  std::vector<Box> boxes_;    ///< of the bodies
  std::vector<glm::dvec3> middles_;
  double rounding_ = 0.0;  ///< beyond that of any corner's distance along a direction
  bool any_hub_ = false;
  const Visitor* visitor_ = nullptr;
  bool ended_ = false;
};

}  // namespace clay::solid
