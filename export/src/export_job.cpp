#include "claystack/export/export_job.hpp"

#include "claystack/export/tessellate.hpp"
#include "claystack/export/wall_thickness.hpp"
#include "describe.hpp"
#include "verify_file.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>

namespace clay::solid {
namespace {

constexpr int kMinDracoBits = 8;
constexpr int kDracoBitsStep = 2;
constexpr int kMaxDracoBits = 30;  // Draco's own limit

constexpr std::array kAllFormats{MeshFormat::stl_binary, MeshFormat::stl_ascii, MeshFormat::obj,
                                 MeshFormat::drc};

std::string stage_name(std::string_view verb, MeshFormat format) {
  return std::string(verb).append("_").append(name_of(format));
}

double largest_radius(const ClayStack& stack) {
  double largest = 0.0;
  for (const Ring& ring : stack.rings()) largest = std::max(largest, ring.outer_mm());
  return largest;
}

/// Steps that float32 cannot hold would leave triangles of no area: 16 units of 2^-24 stand well
/// clear of the one that an embedded annulus needs, and far below any printer's step.
double min_step_mm(const ClayStack& stack) { return std::ldexp(largest_radius(stack), -20); }

Result<void> check_pieces(const std::vector<PieceShape>& shapes, bool allow_pieces) {
  if (shapes.size() < 2 || allow_pieces) return {};
  return failure(ErrorKind::unsound,
                 "expected a pot in one piece, found " + std::to_string(shapes.size()) +
                     " that do not touch: rings " + std::to_string(shapes[0].last_ring) + " and " +
                     std::to_string(shapes[1].first_ring) +
                     " are the first that part; ask for pieces to be exported together (--pieces)");
}

/// The fewest bits that keep the ends of the shortest edge in different cells of Draco's grid.
int least_draco_bits(const TriangleMesh& mesh) {
  glm::dvec3 low = mesh.points.front(), high = low;
  for (const glm::dvec3& p : mesh.points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 sides = high - low;
  const double range = std::max({sides.x, sides.y, sides.z});
  double shortest = range;
  for (const auto& t : mesh.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      shortest = std::min(shortest, glm::distance(mesh.points[t[c]], mesh.points[t[(c + 1) % 3]]));
  const int bits = static_cast<int>(std::ceil(std::min(std::log2(range / shortest + 1.0), 30.0)));
  return std::max(bits, kMinDracoBits);
}

Result<std::size_t> choose_segments(const Profile& profile, double radius, double height_mm,
                                    const ExportOptions& options) {
  std::size_t segments = 0;
  if (options.segments) {
    segments = *options.segments;
    if (segments < kMinSegments || segments > kMaxSegments)
      return failure(ErrorKind::bad_input, "segments: expected " + std::to_string(kMinSegments) +
                                               " to " + std::to_string(kMaxSegments) + ", found " +
                                               std::to_string(segments));
  } else {
    // The vertices stand out a little beyond the radius; the factor 2 covers that and more.
    const double rounding = std::ldexp(2.0 * std::hypot(radius, height_mm), -24);
    const double budget = options.tolerance_mm - rounding;
    segments = segments_for(radius, budget);
    if (!(budget > 0.0) || chordal_error_mm(radius, segments) > budget)
      return failure(ErrorKind::bad_input,
                     "tolerance: expected at least " +
                         in_mm(rounding + chordal_error_mm(radius, kMaxSegments)) +
                         " mm for a pot of this size, found " + in_mm(options.tolerance_mm) +
                         " mm");
  }
  const std::size_t triangles = triangle_count(profile, segments);
  if (triangles > kMaxTriangles)
    return failure(ErrorKind::bad_input, "expected a mesh of at most " +
                                             std::to_string(kMaxTriangles) +
                                             " triangles, found that " + std::to_string(segments) +
                                             " segments make " + std::to_string(triangles) +
                                             "; ask for a larger tolerance or fewer segments");
  return segments;
}

std::vector<LeftOut> left_out(const ClayStack& stack, const std::vector<MeshFormat>& formats,
                              const std::string& no_smoothing) {
  std::vector<LeftOut> list;
  if (!stack.hollow()) list.push_back({"inner shell", "no ring has a bore"});
  if (!no_smoothing.empty()) list.push_back({"smoothing", no_smoothing});
  list.push_back({"union", "the pot has not collapsed"});
  for (const MeshFormat format : kAllFormats)
    if (std::find(formats.begin(), formats.end(), format) == formats.end())
      list.push_back({std::string(name_of(format)), "not asked for"});
  return list;
}

/// Runs stages, tells of each as it begins and adds up its time under its name.
class Stages {
 public:
  Stages(std::vector<StageTime>& times, const std::function<void(std::string_view)>& progress)
      : times_(times), progress_(progress) {}

  template <class Work>
  auto run(const std::string& name, Work work) {
    if (progress_) progress_(name);
    const auto begin = std::chrono::steady_clock::now();
    auto result = work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    const auto known = std::find_if(times_.begin(), times_.end(),
                                    [&](const StageTime& stage) { return stage.name == name; });
    if (known != times_.end())
      known->seconds += spent.count();
    else
      times_.push_back({name, spent.count()});
    return result;
  }

 private:
  std::vector<StageTime>& times_;
  const std::function<void(std::string_view)>& progress_;
};

class ExportJob {
 public:
  ExportJob(const ClayStack& stack, const std::vector<MeshFormat>& formats,
            const ExportOptions& options, const std::function<void(std::string_view)>& progress)
      : stack_(stack),
        formats_(formats),
        options_(options),
        stages_(result_.report.stages, progress) {}

  Result<ExportResult> run() {
    return make_profile()
        .and_then([&] { return prove(); })
        .and_then([&] { return tessellate(); })
        .and_then([&] { return check(); })
        .and_then([&] { return write_all(); })
        .map([&] {
          result_.report.left_out = left_out(stack_, formats_, no_smoothing_);
          return std::move(result_);
        });
  }

 private:
  ExportReport& report() { return result_.report; }

  Result<void> make_profile() {
    return stages_.run("profile", [&] { return profile_of(stack_, min_step_mm(stack_)); })
        .and_then([&](StackProfile found) {
          profile_ = std::move(found.profile);
          report().shapes = std::move(found.shapes);
          report().counted_volume_mm3 = stack_.volume_mm3();
          return check_pieces(report().shapes, options_.allow_pieces);
        });
  }

  /// Smooth walls where they can be proved, the steps as they are where not.
  Result<void> prove() {
    no_smoothing_ = options_.smoothing != Smoothing::none ? smooth() : "not asked for";
    if (no_smoothing_.empty()) return {};
    return stages_.run("certificate", [&] { return certify(profile_); })
        .map([&](const PlanarCertificate& certificate) { report().certificate = certificate; });
  }

  /// The reason why not, or nothing when done.
  std::string smooth() {
    SmoothingOptions how;
    how.mode = options_.smoothing;
    how.tolerance_mm = options_.tolerance_mm;
    auto smoothed = stages_.run("smooth", [&] { return smooth_profile_of(stack_, how); });
    if (!smoothed) return smoothed.error().message;
    const auto certificate =
        stages_.run("certificate", [&] { return certify(smoothed->section.profile); });
    if (!certificate) return "walls too thin for it: " + certificate.error().message;
    profile_ = std::move(smoothed->section.profile);
    report().certificate = *certificate;
    report().smoothing = options_.smoothing;
    return {};
  }

  Result<void> tessellate() {
    const double radius = largest_radius(stack_);
    const auto chosen = choose_segments(profile_, radius, stack_.height_mm(), options_);
    return chosen.map([&](std::size_t segments) {
      mesh_ = stages_.run("tessellate", [&] { return revolve(profile_, segments); });
      report().segments = segments;
      report().min_wall_mm =
          min_wall_mm(profile_) * std::cos(std::numbers::pi / static_cast<double>(segments));
      report().chordal_error_mm = chordal_error_mm(radius, segments);
      report().volume_mm3 = signed_volume(mesh_);
      report().volume_error_relative =
          std::abs(report().volume_mm3 - report().counted_volume_mm3) / report().counted_volume_mm3;
    });
  }

  Result<void> check() {
    report().mesh = stages_.run("check", [&] { return check_mesh(rounded_to_float(mesh_)); });
    if (report().mesh.sound()) return {};
    return failure(ErrorKind::unsound,
                   "the pot in float32: found " + describe(report().mesh.problems.front()));
  }

  Result<void> write_all() {
    for (const MeshFormat format : formats_) {
      auto file = format == MeshFormat::drc ? write_drc() : write_exact(format);
      if (!file) return tl::make_unexpected(file.error());
      result_.files.push_back(std::move(*file));
    }
    return {};
  }

  Result<EncodedMesh> write_exact(MeshFormat format) {
    return write(format, float_rounding_mm(mesh_), [&]() -> Result<std::string> {
      switch (format) {
        case MeshFormat::stl_ascii:
          return encode_stl_ascii(mesh_, options_.name);
        case MeshFormat::obj:
          return encode_obj(mesh_, options_.name);
        default:
          return encode_stl_binary(mesh_);
      }
    });
  }

  /// Draco's grid may press thin walls into each other: more bits until the mesh as decoded is
  /// sound, and where no number of bits will do, the last reason.
  Result<EncodedMesh> write_drc() {
    const double rounding = float_rounding_mm(mesh_);
    const double allowed = std::max(options_.tolerance_mm, rounding);
    DracoSettings settings;
    settings.max_error_mm = allowed;
    Result<EncodedMesh> file;
    for (int bits = least_draco_bits(mesh_); bits <= kMaxDracoBits; bits += kDracoBitsStep) {
      settings.min_bits = bits;
      file =
          write(MeshFormat::drc, allowed + rounding, [&] { return encode_drc(mesh_, settings); });
      if (file || file.error().kind != ErrorKind::unsound) break;
    }
    return file;
  }

  template <class Encode>
  Result<EncodedMesh> write(MeshFormat format, double allowed_mm, Encode encode) {
    auto bytes = stages_.run(stage_name("encode", format), encode);
    if (!bytes) return tl::make_unexpected(bytes.error());
    const auto moved = stages_.run(stage_name("verify", format),
                                   [&] { return verify_file(*bytes, format, mesh_, allowed_mm); });
    if (!moved) return tl::make_unexpected(moved.error());
    return EncodedMesh{format, std::move(*bytes), *moved};
  }

  const ClayStack& stack_;
  const std::vector<MeshFormat>& formats_;
  const ExportOptions& options_;
  Profile profile_;
  std::string no_smoothing_;  ///< why not, where not
  TriangleMesh mesh_;
  ExportResult result_;
  Stages stages_;
};

}  // namespace

Result<ExportResult> run_export(const Pot& pot, const std::vector<MeshFormat>& formats,
                                const ExportOptions& options,
                                const std::function<void(std::string_view)>& progress) {
  if (pot.collapse)
    return failure(ErrorKind::unsound,
                   "a collapsed pot is not supported yet: expected one body of revolution, found "
                   "two overlapping solids, parted above ring " +
                       std::to_string(pot.collapse->failed_ring));
  if (!(options.tolerance_mm > 0.0))
    return failure(ErrorKind::bad_input, "tolerance: expected more than 0 mm, found " +
                                             in_mm(options.tolerance_mm) + " mm");
  try {
    return ExportJob(pot.stack, formats, options, progress).run();
  } catch (const std::exception& e) {
    return failure(ErrorKind::io, std::string("export given up: ") + e.what());
  }
}

}  // namespace clay::solid
