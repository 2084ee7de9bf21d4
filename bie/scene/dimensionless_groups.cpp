#include "bie/scene/dimensionless_groups.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "bie/scene/initial_shape.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/placement.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

constexpr double pi = std::numbers::pi;

/// √(2E:E) of the rate of strain E; the rate of a shear.
double shear_rate(const BackgroundFlow& flow) {
  const Matrix3 strain = 0.5 * (flow.gradient + flow.gradient.transpose());
  return std::sqrt(2.0) * strain.norm();
}

class Groups {
 public:
  explicit Groups(const Scene& scene) : model_(model_of(scene)), size_(size_of(initial_position(scene))) {}

  std::vector<DimensionlessGroup> all() {
    add_geometry();
    if (model_.bending) add_bending();
    if (model_.flow && model_.bending) add_flow();
    if (model_.electric) add_electric();
    return groups_;
  }

 private:
  void add(DimensionlessGroup group) { groups_.push_back(group); }

  void add_geometry() {
    add({"radius", "a", radius(), "length", "√(A/4π)"});
    add({"reduced volume", "v", 3.0 * size_.volume / (4.0 * pi * std::pow(radius(), 3)), "1",
         "volume over that of the sphere with the same area"});
    add({"excess area", "Δ", size_.area / std::pow(3.0 * size_.volume / (4.0 * pi), 2.0 / 3.0) - 4.0 * pi, "1",
         "A/a_V² − 4π, a_V the radius of the sphere with the same volume"});
  }

  void add_bending() { add({"bending time", "t_κ", bending_time(), "time", "μa³/κ_B: shapes relax by bending"}); }

  void add_flow() {
    add({"capillary number of the flow", "χ", shear_rate(*model_.flow) * bending_time(), "1",
         "μγ̇a³/κ_B: viscous stress over bending stress"});
  }

  void add_electric() {
    const ElectricParameters& electric = *model_.electric;
    const double inside = electric.conductivity_in, outside = electric.conductivity_out;
    if (outside > 0.0) {
      add({"conductivity ratio", "R", inside / outside, "1", "σ_i/σ_e"});
      add({"membrane conductance", "g", model_.charging->conductance * radius() / outside, "1",
           "G_m a/σ_e: leak of the membrane over conduction of the fluid"});
    }
    const double series = 2.0 * inside * outside / (inside + 2.0 * outside);
    const double rate = model_.charging->conductance + series / radius();
    if (rate > 0.0) {
      add({"charging time", "t_m", model_.charging->capacitance / rate, "time",
           "C_m/(G_m + 2σ_iσ_e/((σ_i + 2σ_e)a)): a sphere's membrane charges"});
    }
    const double stress = electric.permittivity * electric.field.squaredNorm();
    if (stress == 0.0) return;
    add({"electric time", "t_el", model_.viscosity / stress, "time", "μ/(εE²): the field deforms the membrane"});
    if (model_.bending) {
      add({"electric capillary number", "Ca", stress / model_.bending->modulus * 3.0 * size_.volume / (4.0 * pi), "1",
           "εE²/κ_B · 3V/4π, Eq. (36): electric stress over bending stress"});
    }
    if (model_.flow) {
      add({"Mason number", "Mn", model_.viscosity * shear_rate(*model_.flow) / stress, "1",
           "μγ̇/(εE²): viscous stress over electric stress"});
    }
  }

  [[nodiscard]] double radius() const { return std::sqrt(size_.area / (4.0 * pi)); }
  [[nodiscard]] double bending_time() const {
    return model_.viscosity * std::pow(radius(), 3) / model_.bending->modulus;
  }

  Model model_;
  ShapeSize size_;
  std::vector<DimensionlessGroup> groups_;
};

}  // namespace

std::vector<DimensionlessGroup> dimensionless_groups(const Scene& scene) { return Groups(scene).all(); }

std::string si_text(const Scene& scene, const DimensionlessGroup& group) {
  const Dimension* dimension = find_dimension(group.unit);
  if (dimension == nullptr || !scene.units) return {};
  const auto scale = reference_scale(*scene.units, *dimension);
  return scale ? fmt::format("{:.4g} {}", group.value * *scale, dimension->si_unit()) : std::string();
}

}  // namespace vehd
