#include <cmath>
#include <numbers>
#include <string>

#include "bie/scene/model_of.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {
namespace {

/// Relative rounding of decimal input.
constexpr double kRounding = 1e-12;

/// The applied flow must vanish on the wall as far as the wall requires: v on a no-slip wall, n·v and the shear stress
/// on a stress-free one. Flows are linear in x or quadratic across their axis, in the coordinates of the scene.
class WallChecks {
 public:
  WallChecks(const Scene& scene, const TomlFile& file)
      : scene_(scene), file_(file), model_(model_of(scene)), wall_(*model_.wall) {}

  void run() const {
    if (wall_.flow == WallFlow::none && wall_.field == WallField::none) {
      file_.refuse(table(),
                   "[wall] has no effect; accepted: \"flow\" no-slip or stress-free, \"field\" insulating or "
                   "electrode, or both");
    }
    if (wall_.field != WallField::none) check_field();
    if (wall_.flow != WallFlow::none) check_flow();
    check_positions();
  }

 private:
  [[nodiscard]] const toml::node& table() const { return *file_.table.get("wall"); }

  void check_field() const {
    if (!scene_.electric) {
      file_.refuse_key("wall", "field", "\"field\" in [wall] has no effect without [electric]; accepted: none");
    }
    if (!(scene_.electric->conductivity_in > 0.0 && scene_.electric->conductivity_out > 0.0)) {
      file_.refuse_key("wall", "field",
                       "\"conductivity_in\" or \"conductivity_out\" in [electric] is 0; accepted with \"field\" "
                       "in [wall]: > 0, as small as needed");
    }
    const Vector3 field = vector_of(scene_.electric->field);
    const Vector3 normal_part = field.dot(wall_.normal) * wall_.normal;
    const bool insulates = wall_.field == WallField::insulating;
    const Vector3 excluded = insulates ? normal_part : Vector3(field - normal_part);
    if (excluded.norm() <= kRounding * field.norm()) return;
    const toml::node& key = file_.node_of("electric", "field");
    if (insulates)
      file_.refuse(key, "\"field\" in [electric] crosses an insulating wall; accepted: one along the wall");
    file_.refuse(key, "\"field\" in [electric] has a part along an electrode; accepted: one normal to the wall");
  }

  void check_flow() const {
    if (!model_.mobile) {
      file_.refuse_key("wall", "flow",
                       "\"flow\" in [wall] has no effect while \"mobile\" in [membrane] is false; "
                       "accepted: none");
    }
    if (!scene_.flow) return;
    if (model_.flow ? allows(model_.flow->gradient) : allows_poiseuille()) return;
    const toml::node& kind = file_.node_of("flow", "kind");
    if (wall_.flow == WallFlow::no_slip) {
      file_.refuse(kind,
                   "[flow] does not vanish on the wall, which is without slip; accepted: a flow that does, such as "
                   "\"shear\" with a wall in the plane z = 0");
    }
    file_.refuse(kind,
                 "[flow] crosses the stress-free wall or shears it; accepted: a flow along it without shear stress "
                 "there");
  }

  /// Is a flow that is linear in x allowed?
  [[nodiscard]] bool allows(const Matrix3& gradient) const {
    const Vector3& n = wall_.normal;
    const Matrix3 along = Matrix3::Identity() - n * n.transpose();
    const Vector3 at_wall = gradient * (n.dot(wall_.point) * n);
    const double size = kRounding * gradient.norm(), velocity = size * wall_.point.norm();
    if (wall_.flow == WallFlow::no_slip) {
      return (gradient * along).norm() <= size && at_wall.norm() <= velocity;
    }
    return (n.transpose() * gradient * along).norm() <= size && std::abs(n.dot(at_wall)) <= velocity &&
           (along * (gradient + gradient.transpose()) * n).norm() <= size;
  }

  /// Is a flow along x allowed? Through a tube it vanishes on no plane; planes through its axis are not sheared.
  [[nodiscard]] bool allows_poiseuille() const {
    const Vector3 n = wall_.normal.cwiseAbs();
    const double height = std::abs(wall_.normal.dot(wall_.point)), rounding = kRounding * wall_.point.norm();
    const bool slit = scene_.flow->section == FlowSection::slit;
    if (wall_.flow == WallFlow::no_slip) {
      return slit && n.head<2>().norm() <= kRounding && std::abs(height - scene_.flow->radius) <= rounding;
    }
    const bool across_slit = slit && n.z() <= kRounding;
    return n.x() <= kRounding && (across_slit || (height <= rounding && (!slit || n.y() <= kRounding)));
  }

  void check_positions() const {
    std::size_t a = 0;
    for (const Scene& one : each_alone(scene_)) {
      const Matrix position = initial_position(one);
      const double radius = std::sqrt(size_of(position).area / (4.0 * std::numbers::pi));
      const double gap = nearest_to_wall(wall_, position).distance / radius;
      const std::string called =
          scene_.vesicles.empty() ? "the vesicle" : "vesicle \"" + scene_.vesicles[a].name + "\"";
      ++a;
      if (gap >= thresholds::smallest_gap) continue;
      if (gap > 0.0) {
        file_.refuse(table(), "{} is {:.2g} radii from the wall; accepted: at least {:g}", called, gap,
                     thresholds::smallest_gap);
      }
      file_.refuse(table(),
                   "{} extends {:.3g} radii beyond the wall; accepted: all of it on the side that \"normal\" points to",
                   called, -gap);
    }
  }

  const Scene& scene_;
  const TomlFile& file_;
  const Model model_;
  const Wall wall_;
};

}  // namespace

void check_wall(const Scene& scene, const TomlFile& file) {
  if (scene.wall->normal == Triple{}) {
    file.refuse_key("wall", "normal", "\"normal\" in [wall] is 0, 0, 0; accepted: a vector that is not zero");
  }
  WallChecks(scene, file).run();
}

}  // namespace vehd
