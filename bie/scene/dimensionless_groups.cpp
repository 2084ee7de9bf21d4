#include "bie/scene/dimensionless_groups.hpp"

#include <cmath>
#include <numbers>

#include "bie/physics/averaged_field.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

constexpr double pi = std::numbers::pi;

class Groups {
 public:
  explicit Groups(const Scene& scene)
      : scene_(scene),
        model_(model_of(scene)),
        vesicle_(model_.vesicles.front()),
        size_(size_of(initial_position(scene))) {}

  std::vector<DimensionlessGroup> all() {
    const double v = 3.0 * size_.volume / (4.0 * pi);
    groups_.push_back({"radius", "a", radius(), "length", "√(A/4π)"});
    number("reduced volume", "v", v / std::pow(radius(), 3), "volume over that of the sphere with the same area");
    number("excess area", "Δ", size_.area / std::pow(v, 2.0 / 3.0) - 4.0 * pi,
           "A/a_V² − 4π, a_V the radius of the sphere with the same volume");
    if (vesicle_.viscosity_ratio != 1.0) number("viscosity ratio", "Λ", vesicle_.viscosity_ratio, "μ_i/μ_e");
    if (vesicle_.bending) add_bending();
    if (shear_rate() > 0.0) {
      time("flow time", "t_γ", 1.0 / shear_rate(), "1/γ̇: the flow turns and stretches the vesicle");
      if (vesicle_.bending) {
        number("capillary number of the flow", "χ", shear_rate() * bending_time(),
               "μγ̇a³/κ_B: viscous stress over bending stress");
      }
    }
    if (scene_.gravity) {
      time("sedimentation time", "t_g", model_.viscosity / (weight() * radius()),
           "μ/(|ρ_i − ρ_e|ga): its weight moves the vesicle by about its radius");
    }
    if (model_.electric) add_electric();
    return groups_;
  }

 private:
  void number(std::string_view name, std::string_view symbol, double value, std::string_view meaning) {
    groups_.push_back({name, symbol, value, "1", meaning});
  }
  void time(std::string_view name, std::string_view symbol, double value, std::string_view meaning) {
    groups_.push_back({name, symbol, value, "time", meaning});
  }

  void add_bending() {
    time("bending time", "t_κ", bending_time(), "μa³/κ_B: shapes relax by bending");
    if (const double curvature = scene_.membrane.spontaneous_curvature * radius(); curvature != 0.0) {
      number("spontaneous curvature", "c₀", curvature, "ca, −1 on a sphere; the usual C₀ is −2c");
      number("the usual spontaneous curvature", "C₀a", -2.0 * curvature,
             "−2ca of (κ_c/2)∫(C₁ + C₂ − C₀)² dA with κ_c = κ_B/2, 2 on a sphere");
    }
    if (!scene_.gravity) return;
    number("Bond number", "Bo", weight() * std::pow(radius(), 4) / vesicle_.bending->modulus,
           "|ρ_i − ρ_e|ga⁴/κ_B: weight over bending force");
  }

  void add_electric() {
    const ElectricParameters electric = electric_parameters(model_, vesicle_);
    const double inside = electric.conductivity_in, outside = electric.conductivity_out;
    if (outside > 0.0) {
      number("conductivity ratio", "R", inside / outside, "σ_i/σ_e");
      number("membrane conductance", "g", vesicle_.charging.conductance * radius() / outside,
             "G_m a/σ_e: leak of the membrane over conduction of the fluid");
    }
    const double series = 2.0 * inside * outside / (inside + 2.0 * outside);
    const double rate = vesicle_.charging.conductance + series / radius();
    if (rate > 0.0) {
      const double charging_time = vesicle_.charging.capacitance / rate;
      time("charging time", "t_m", charging_time, "C_m/(G_m + 2σ_iσ_e/((σ_i + 2σ_e)a)): a sphere's membrane charges");
      const auto& waveform = scene_.electric->waveform;
      if (waveform && alternates(*waveform)) {
        number("frequency", "ωt_m", 2.0 * pi * waveform->frequency * charging_time,
               "2πf t_m: above 1 the field passes through the membrane");
      }
    }
    if (electric.permittivity_ratio != 1.0) {
      number("permittivity ratio", "S", electric.permittivity_ratio, "ε_i/ε_e");
    }
    // Without units the permittivity only scales the stress, as in the paper, independently of the conductivities.
    if (scene_.units || electric.displacement_current) {
      time("Maxwell–Wagner time", "t_MW",
           electric.permittivity * (electric.permittivity_ratio + 2.0) / (inside + 2.0 * outside),
           "(ε_i + 2ε_e)/(σ_i + 2σ_e): the charge of the fluids relaxes");
    }
    const double stress = electric.permittivity * electric.field.squaredNorm();
    if (stress == 0.0) return;
    if (electric.averaged_frequency) {
      const double drive = sphere_in_ac_field(electric, vesicle_.charging, radius()).drive;
      number("drive of the averaged field", "Q", drive / electric.permittivity,
             "P₂ part of its stress over ε: above 0 a nearly spherical vesicle becomes prolate along the field");
      number("ripple", "s₂",
             ripple_amplitude(electric, vesicle_.charging, radius(), model_.viscosity, vesicle_.viscosity_ratio),
             "amplitude over a of the motion at 2f, which the average leaves out, of a sphere: "
             "εE²|Q₂|/((32 + 23Λ)μ 2ω)");
    }
    time("electric time", "t_el", model_.viscosity / stress, "μ/(εE²): the field deforms the membrane");
    if (vesicle_.bending) {
      number("electric capillary number", "Ca", stress / vesicle_.bending->modulus * 3.0 * size_.volume / (4.0 * pi),
             "εE²/κ_B · 3V/4π, Eq. (36): electric stress over bending stress");
    }
    if (shear_rate() > 0.0) {
      number("Mason number", "Mn", model_.viscosity * shear_rate() / stress,
             "μγ̇/(εE²): viscous stress over electric stress");
    }
  }

  /// √(2E:E) of the rate of strain E: the rate of a shear; for a Poiseuille flow at the distance a from its axis.
  [[nodiscard]] double shear_rate() const {
    if (!scene_.flow) return 0.0;
    const FlowScene& flow = *scene_.flow;
    if (flow.kind == FlowKind::poiseuille) {
      return 2.0 * std::abs(flow.centre_velocity) * radius() / (flow.radius * flow.radius);
    }
    const Matrix3& gradient = model_.flow->gradient;
    return std::sqrt(0.5) * (gradient + gradient.transpose()).norm();
  }
  /// Weight per volume.
  [[nodiscard]] double weight() const {
    return std::abs(scene_.fluid.density_difference) * vector_of(scene_.gravity->acceleration).norm();
  }
  [[nodiscard]] double radius() const { return std::sqrt(size_.area / (4.0 * pi)); }
  [[nodiscard]] double bending_time() const {
    return model_.viscosity * std::pow(radius(), 3) / vesicle_.bending->modulus;
  }

  const Scene& scene_;
  Model model_;
  VesicleModel vesicle_;
  ShapeSize size_;
  std::vector<DimensionlessGroup> groups_;
};

}  // namespace

std::vector<DimensionlessGroup> dimensionless_groups(const Scene& scene) { return Groups(scene).all(); }

std::string si_text(const Scene& scene, const DimensionlessGroup& group) {
  const double scale = si_scale(scene.units, group.unit);
  return group.unit == "1" || std::isnan(scale) ? std::string() : si_number(group.value * scale, group.unit);
}

}  // namespace vehd
