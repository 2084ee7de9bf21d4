#include "tests/invariance/moved_scene.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "bie/scene/model_of.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd::testing {
namespace {

class UniformDrift : public ExplicitEffect {
 public:
  explicit UniformDrift(Vector3 velocity) : velocity_(std::move(velocity)) {}

  [[nodiscard]] EffectDescription description() const override { return {"uniform drift", "v", {}, {}}; }
  void add(const EffectInput&, Forcing& forcing) const override {
    forcing.velocity.row(0) += std::sqrt(4.0 * std::numbers::pi) * velocity_.transpose();
  }
  [[nodiscard]] bool is_invariant_under(const Reflection& g) const override {
    return Vector3(g.x * velocity_.x(), g.y * velocity_.y(), g.z * velocity_.z()) == velocity_;
  }
  [[nodiscard]] bool is_axisymmetric() const override { return velocity_.head<2>().isZero(0.0); }
  [[nodiscard]] bool is_translation_invariant() const override { return true; }
  [[nodiscard]] std::shared_ptr<const ExplicitEffect> rotated(const Matrix3& rotation) const override {
    return uniform_drift(rotation * velocity_);
  }

 private:
  Vector3 velocity_;
};

Vector3 vector_of(const Triple& t) { return {t[0], t[1], t[2]}; }
Triple triple_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

AxisAngle axis_angle_of(const Matrix3& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return {turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle() * 180.0 / std::numbers::pi};
}

void turn_flow(FlowScene& flow, const Model& model, const Matrix3& rotation) {
  if (flow.kind == FlowKind::poiseuille) return;
  const Matrix3 gradient = rotation * model.flow->gradient * rotation.transpose();
  flow.kind = FlowKind::gradient;
  for (int i = 0; i < 3; ++i) flow.gradient[i] = triple_of(gradient.row(i));
}

}  // namespace

Scene rotated_scene(Scene scene, const AxisAngle& by) {
  if (!scene.vesicles.empty()) {
    std::vector<Scene> each = each_alone(scene);
    for (Scene& one : each) one = rotated_scene(std::move(one), by);
    return together(each, vesicle_names(scene));
  }
  const Matrix3 rotation = rotation_matrix(by);
  const Model model = model_of(scene);
  const Matrix3 before = scene.shape.rotation ? rotation_matrix(*scene.shape.rotation) : Matrix3(Matrix3::Identity());
  scene.shape.rotation = axis_angle_of(rotation * before);
  const auto turn = [&](Triple& t) { t = triple_of(rotation * vector_of(t)); };
  turn(scene.shape.centre);
  if (scene.electric) turn(scene.electric->field);
  if (scene.gravity) turn(scene.gravity->acceleration);
  if (scene.wall) {
    turn(scene.wall->point);
    turn(scene.wall->normal);
  }
  if (scene.flow) turn_flow(*scene.flow, model, rotation);
  return scene;
}

Scene shifted_scene(Scene scene, const Vector3& by) {
  const auto shift = [&](Triple& centre) { centre = triple_of(vector_of(centre) + by); };
  shift(scene.shape.centre);
  for (VesicleScene& vesicle : scene.vesicles) shift(vesicle.shape.centre);
  if (scene.wall) shift(scene.wall->point);
  return scene;
}

std::shared_ptr<const ExplicitEffect> uniform_drift(const Vector3& velocity) {
  return std::make_shared<UniformDrift>(velocity);
}

}  // namespace vehd::testing
