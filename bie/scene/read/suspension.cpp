#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/potentials/nearest_points.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// Most random positions tried for each vesicle, and most of these that need a comparison of the shapes.
constexpr int kTries = 20000, kExactTries = 500;
/// Highest degree for comparing shapes, which is enough to place them.
constexpr int kHighestOrder = 12;

/// Random numbers that are the same on every platform.
class Random {
 public:
  explicit Random(int seed) : bits_(static_cast<std::uint64_t>(seed)) {}

  /// Uniform in [−1, 1).
  double number() { return static_cast<double>(bits_() >> 11) * 0x1p-52 - 1.0; }
  Vector3 in_cube() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Vector3 in_ball() {
    Vector3 v = in_cube();
    while (v.squaredNorm() > 1.0) v = in_cube();
    return v;
  }
  /// Uniform over all orientations.
  Eigen::Quaterniond rotation() {
    for (;;) {
      const double w = number();
      const Vector3 v = in_cube();
      const double squared = w * w + v.squaredNorm();
      if (squared <= 1.0 && squared > 0.01) return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized();
    }
  }

 private:
  std::mt19937_64 bits_;
};

/// Common shape of the vesicles, about its origin.
struct CopiedShape {
  Matrix position;  ///< without rotation
  double volume, radius, inner, outer;

  explicit CopiedShape(Scene one) {
    one.suspension.reset();
    one.shape.centre = {};
    one.shape.rotation.reset();
    one.numerics.order = std::min(one.numerics.order, kHighestOrder);
    position = initial_position(one);
    const int order = order_of(position.rows());
    const Surface s = make_surface(SphereTransform(order, make_grid(4 * order)), position);
    volume = enclosed_volume(s);
    radius = std::sqrt(surface_area(s) / (4.0 * std::numbers::pi));
    inner = s.position.rowwise().norm().minCoeff();
    outer = s.position.rowwise().norm().maxCoeff();
  }
};

struct PlacedVesicle {
  Vector3 centre;
  std::optional<AxisAngle> rotation;
};

class Placement {
 public:
  Placement(const Scene& one, const TomlFile& file)
      : one_(one), suspension_(*one.suspension), file_(file), shape_(one), random_(suspension_.seed) {}

  std::vector<PlacedVesicle> run() {
    const int count = counted();
    std::vector<PlacedVesicle> placed;
    while (static_cast<int>(placed.size()) < count) {
      if (const auto next = next_beside(placed)) {
        placed.push_back(*next);
        continue;
      }
      refuse(
          amount_key(),
          "no room for the vesicles of [suspension]: {} of {} found a place, {:.3g} of the volume; accepted: fewer, a "
          "larger region or a smaller \"gap\"",
          placed.size(), count, static_cast<double>(placed.size()) * shape_.volume / region_volume());
    }
    return placed;
  }

 private:
  template <typename... Arguments>
  [[noreturn]] void refuse(std::string_view key, fmt::format_string<Arguments...> problem,
                           Arguments&&... arguments) const {
    file_.refuse_key("suspension", key, problem, std::forward<Arguments>(arguments)...);
  }

  [[nodiscard]] bool is_box() const { return suspension_.kind == SuspensionKind::box; }

  [[nodiscard]] std::string_view amount_key() const { return suspension_.count ? "count" : "volume_fraction"; }

  [[nodiscard]] double region_volume() const {
    return is_box() ? suspension_.size[0] * suspension_.size[1] * suspension_.size[2]
                    : 4.0 / 3.0 * std::numbers::pi * std::pow(suspension_.radius, 3);
  }

  [[nodiscard]] int counted() const {
    if (suspension_.count.has_value() == suspension_.volume_fraction.has_value()) {
      refuse("kind", "[suspension] accepts one of \"count\" and \"volume_fraction\"");
    }
    const double most = static_cast<double>(most_vesicles);
    const double count = suspension_.count ? static_cast<double>(*suspension_.count)
                                           : std::round(*suspension_.volume_fraction * region_volume() / shape_.volume);
    if (suspension_.count && count > most) {
      refuse("count", "\"count\" in [suspension] is {}; accepted: at most {}", *suspension_.count, most_vesicles);
    }
    if (!(count >= 1.0 && count <= most)) {
      refuse("volume_fraction", "\"volume_fraction\" in [suspension] makes {:.6g} vesicles; accepted: 1 to {}", count,
             most_vesicles);
    }
    const double narrowest = is_box() ? *std::ranges::min_element(suspension_.size) : 2.0 * suspension_.radius;
    if (narrowest < 2.0 * shape_.outer) {
      refuse(is_box() ? "size" : "radius",
             "the region of [suspension] is {:.3g} wide; accepted: at least {:.3g}, the width of a vesicle", narrowest,
             2.0 * shape_.outer);
    }
    if (count * shape_.volume > region_volume()) {
      refuse(amount_key(),
             "{:.6g} vesicles have {:.3g} times the volume of the region of [suspension]; accepted: less than 1", count,
             count * shape_.volume / region_volume());
    }
    return static_cast<int>(count);
  }

  std::optional<PlacedVesicle> next_beside(const std::vector<PlacedVesicle>& placed) {
    int exact_tries = 0;
    for (int i = 0; i < kTries && exact_tries < kExactTries; ++i) {
      PlacedVesicle candidate{random_centre(), one_.shape.rotation};
      if (suspension_.orientation == SuspensionOrientation::random) {
        const Eigen::AngleAxisd turn(random_.rotation());
        candidate.rotation =
            AxisAngle{turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle() * 180.0 / std::numbers::pi};
      }
      if (is_free(candidate, placed, exact_tries)) return candidate;
    }
    return std::nullopt;
  }

  /// Random centre with the whole vesicle inside the region.
  Vector3 random_centre() {
    const Vector3 centre = vector_of(suspension_.centre);
    if (!is_box()) return centre + (suspension_.radius - shape_.outer) * random_.in_ball();
    const Vector3 half = 0.5 * vector_of(suspension_.size) - Vector3::Constant(shape_.outer);
    return centre + random_.in_cube().cwiseProduct(half.cwiseMax(0.0));
  }

  [[nodiscard]] bool is_free(const PlacedVesicle& candidate, const std::vector<PlacedVesicle>& placed,
                             int& exact_tries) const {
    const double gap = suspension_.gap * shape_.radius;
    std::vector<const PlacedVesicle*> neighbours;
    for (const PlacedVesicle& other : placed) {
      const double distance = (other.centre - candidate.centre).norm();
      if (distance < 2.0 * shape_.inner + gap) return false;
      if (distance < 2.0 * shape_.outer + gap) neighbours.push_back(&other);
    }
    if (neighbours.empty()) return true;
    ++exact_tries;
    const Matrix own = position_of(candidate);
    const auto is_apart = [&](const PlacedVesicle* other) {
      try {
        const Matrix position = position_of(*other);
        return arrangement_of(own, position) == Arrangement::apart && nearest_points(own, position).gap >= gap;
      } catch (const ConvergenceError&) {
        return false;
      }
    };
    return std::ranges::all_of(neighbours, is_apart);
  }

  [[nodiscard]] Matrix position_of(const PlacedVesicle& vesicle) const {
    const Matrix3 rotation = vesicle.rotation ? rotation_matrix(*vesicle.rotation) : Matrix3(Matrix3::Identity());
    Matrix moved = shape_.position * rotation.transpose();
    moved.row(0) += coefficient_of_one * vesicle.centre.transpose();
    return moved;
  }

  const Scene& one_;
  const SuspensionScene& suspension_;
  const TomlFile& file_;
  CopiedShape shape_;
  Random random_;
};

}  // namespace

Scene placed_suspension(const Scene& one, const TomlFile& file) {
  std::vector<Scene> scenes;
  std::vector<std::string> names;
  for (const PlacedVesicle& placed : Placement(one, file).run()) {
    Scene& scene = scenes.emplace_back(one);
    scene.suspension.reset();
    scene.shape.centre = {placed.centre.x(), placed.centre.y(), placed.centre.z()};
    scene.shape.rotation = placed.rotation;
    names.push_back(fmt::format("{}", names.size()));
  }
  return together(scenes, names);
}

}  // namespace vehd
