#include "bie/scene/poration_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "bie/geometry/roundness.hpp"
#include "bie/scene/initial_shape.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

class PorationChecks {
 public:
  PorationChecks(const Scene& scene, const toml::table& table, const std::string& file)
      : scene_(scene), poration_(*scene.poration), table_(table), file_(file) {}

  void run() const {
    if (has_averaged_field(scene_)) {
      refuse(
          "model",
          "\"average\" in [electric.waveform] is true with [poration], which asks for V_m at every moment; accepted: "
          "false");
    }
    if (poration_.model == PorationModel::criterion) {
      check_criterion();
    } else {
      check_reaction();
    }
  }

 private:
  [[noreturn]] void refuse(std::string_view key, const std::string& problem) const {
    refuse_key(table_, "poration", key, file_, problem);
  }

  void check_criterion() const {
    if (!poration_.threshold_potential && !poration_.lysis_tension) {
      refuse("model", "missing key \"threshold_Vm\" or \"lysis_tension\" in [poration]; accepted: one or both");
    }
    if (poration_.threshold_potential && !scene_.electric) {
      refuse("threshold_Vm", "\"threshold_Vm\" in [poration] has no effect without [electric]");
    }
    if (poration_.lysis_tension && !(scene_.membrane.inextensible && scene_.membrane.mobile)) {
      refuse("lysis_tension",
             "\"lysis_tension\" in [poration] has no effect without a tension; accepted: \"inextensible\" and "
             "\"mobile\" in [membrane] true");
    }
    if (poration_.lysis_tension && is_sphere()) {
      refuse("lysis_tension",
             "\"lysis_tension\" in [poration] of a sphere: a uniform tension of any size moves nothing there, so the "
             "tension is not determined; accepted: another [shape], or \"threshold_Vm\" alone");
    }
  }

  [[nodiscard]] bool is_sphere() const {
    const Matrix position = initial_position(scene_);
    const int order = order_of(position.rows());
    const Surface shape = make_surface(SphereTransform(order, make_grid(order)), position);
    const double radius = std::sqrt(surface_area(shape) / (4.0 * std::numbers::pi));
    return distance_variation(shape) < thresholds::sphere_variation * radius;
  }

  void check_reaction() const {
    if (!scene_.electric) refuse("model", "[poration] acts on nothing without [electric]; accepted: model = criterion");
    if (scene_.electric->initial_potential == InitialPotential::steady) {
      refuse("model",
             "[poration] with a steady \"initial_Vm\" in [electric], under which a membrane would porate at once; "
             "accepted: zero or file");
    }
    if (poration_.model == PorationModel::porosity && poration_.resealing_time <= poration_.poration_time) {
      refuse("resealing_time",
             fmt::format("\"resealing_time\" in [poration] is {:g}; accepted: more than the \"poration_time\" {:g}",
                         poration_.resealing_time, poration_.poration_time));
    }
    const ElectricScene& electric = *scene_.electric;
    if (poration_.model == PorationModel::pores && !poration_.pore_conductivity &&
        (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0)) {
      refuse("model",
             "missing key \"pore_conductivity\" in [poration]: a conductivity in [electric] is 0; accepted: > 0");
    }
  }

  const Scene& scene_;
  const PorationScene& poration_;
  const toml::table& table_;
  const std::string& file_;
};

}  // namespace

void check_poration(const Scene& scene, const toml::table& table, const std::string& file) {
  if (scene.poration) PorationChecks(scene, table, file).run();
}

}  // namespace vehd
