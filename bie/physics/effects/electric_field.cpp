#include "bie/physics/effects/electric_field.hpp"

#include "bie/physics/electric.hpp"
#include "bie/physics/model.hpp"

namespace vehd {

namespace {

constexpr const char* kElectricField = "electric field";
constexpr const char* kPump = "pump";
constexpr const char* kSpatialVariation = "spatially varying membrane";

class ElectricField : public Effect {
 public:
  explicit ElectricField(ElectricParameters electric) : electric_(std::move(electric)) {}

  [[nodiscard]] EffectDescription description() const override {
    EffectDescription d;
    d.name = kElectricField;
    d.adds = "f_E = [[n.Sigma_el]], Eqs. (3), (11)-(15); C_m dV/dt + G_m V = -sigma_i dphi_i/dn, Eq. (30)";
    d.operators = {{&LayerSelection::laplace_single, "D' of V_m, Eq. (24)"},
                   {&LayerSelection::laplace_double, "potentials on the membrane, Eq. (11)"},
                   {&LayerSelection::stokes_single, "velocity of f_E, Eq. (5)"}};
    d.unknowns = {"V_m"};
    if (electric_.displacement_current) {
      d.adds =
          "f_E = [[n.Sigma_el]], Eqs. (3), (11), (15); free charge of both faces, D q_i/Dt = sigma_i E_i - G_m V, "
          "D q_e/Dt = G_m V - sigma_e E_e";
    }
    if (electric_.averaged_frequency) {
      d.adds = std::string(
                   "mean of f_E over a period; (1/2 + eta S') y V - kappa D'[V] = kappa E.n, y = G_m + i omega C_m, "
                   "eta and kappa of K = sigma") +
               (electric_.displacement_current ? " + i omega epsilon" : "");
      d.unknowns = {"Re V_m", "Im V_m"};
    }
    if (carries_charge(electric_)) {
      d.operators.push_back({&LayerSelection::laplace_adjoint, "charge density, Eq. (12)"});
      if (!electric_.averaged_frequency && !electric_.displacement_current) d.unknowns.emplace_back("g");
    }
    return d;
  }
  /// Reversing the field reverses V_m.
  [[nodiscard]] int potential_sign(const Reflection& g) const override {
    constexpr double kRounding = 1e-12;
    const Vector3& field = electric_.field;
    const Vector3 image(g.x * field.x(), g.y * field.y(), g.z * field.z());
    const auto is_field = [&](const Vector3& other) {
      return (other - field).cwiseAbs().maxCoeff() <= kRounding * field.cwiseAbs().maxCoeff();
    };
    return is_field(image) ? 1 : is_field(-image) ? -1 : 0;
  }
  [[nodiscard]] bool is_axisymmetric() const override { return electric_.field.head<2>().isZero(0.0); }
  [[nodiscard]] std::vector<Vector3> axis_candidates() const override { return {electric_.field}; }
  [[nodiscard]] std::optional<double> next_discontinuity(double time) const override {
    return electric_.waveform.next_discontinuity(time);
  }
  [[nodiscard]] bool jumps_at(double time) const override { return electric_.waveform.jumps_at(time); }

 private:
  ElectricParameters electric_;
};

class Pump : public Effect {
 public:
  explicit Pump(Waveform waveform) : waveform_(std::move(waveform)) {}

  [[nodiscard]] EffectDescription description() const override {
    return {kPump, "J_p in C_m dV_m/dt + G_m V_m + J_p = -sigma_i dphi_i/dn", {}, {}};
  }
  [[nodiscard]] std::optional<double> next_discontinuity(double time) const override {
    return waveform_.next_discontinuity(time);
  }
  [[nodiscard]] bool jumps_at(double time) const override { return waveform_.jumps_at(time); }

 private:
  Waveform waveform_;
};

}  // namespace

EffectRow applied_field_row() {
  return {kElectricField,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.electric) return nullptr;
            return std::make_shared<ElectricField>(electric_parameters(model, vesicle));
          },
          [](Model& model, VesicleModel& vesicle) {
            model.electric.reset();
            vesicle.reaction.reset();
            vesicle.pump.reset();
          }};
}

EffectRow pump_row() {
  return {kPump,
          [](const Model& model, const VesicleModel& vesicle) -> MadeEffect {
            if (!model.electric || !vesicle.pump) return nullptr;
            return std::make_shared<Pump>(*vesicle.pump);
          },
          [](Model&, VesicleModel& vesicle) { vesicle.pump.reset(); }};
}

EffectRow spatial_variation_row() {
  return {kSpatialVariation,
          [](const Model&, const VesicleModel& vesicle) -> MadeEffect {
            if (!vesicle.has_varying_properties) return nullptr;
            return described([] {
              return EffectDescription{
                  kSpatialVariation, "C_m, G_m, kappa_B or c as functions of the material point", {}, {}};
            });
          },
          [](Model&, VesicleModel& vesicle) { vesicle.has_varying_properties = false; }};
}

}  // namespace vehd
