#include "bie/physics/effects/wall_effect.hpp"

#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kWall = "wall";

/// Invariant under translations, because the wall moves with the origin of the frame.
class WallEffect : public Effect {
 public:
  explicit WallEffect(const Wall& wall) : wall_(wall) {}

  [[nodiscard]] EffectDescription description() const override {
    return {kWall, "in every layer those of the mirrored membranes", {}, {}};
  }
  [[nodiscard]] int potential_sign(const Reflection& g) const override {
    return wall_.normal.cwiseProduct(Vector3(g.x, g.y, g.z)) == wall_.normal ? 1 : 0;
  }
  [[nodiscard]] bool is_axisymmetric() const override { return wall_.normal.head<2>().isZero(0.0); }
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override { return {wall_.normal}; }

 private:
  Wall wall_;
};

}  // namespace

EffectRow wall_row() {
  return {kWall,
          [](const Model& model, const VesicleModel&) -> MadeEffect {
            return model.wall ? std::make_shared<WallEffect>(*model.wall) : nullptr;
          },
          [](Model& model, VesicleModel&) { model.wall.reset(); }};
}

}  // namespace vehd
