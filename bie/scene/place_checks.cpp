#include "bie/scene/place_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "bie/scene/initial_material.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Of a cap that the degree cuts, over its step: what it may be wrong by, and hence fall below zero.
constexpr double largest_truncation = 0.02;

/// A property and what its table is called.
struct Property {
  std::string_view table;
  const PlaceScene* places;
  bool is_electric;
};

class PlaceChecks {
 public:
  PlaceChecks(const Scene& scene, const toml::table& table, const std::string& file)
      : scene_(scene), membrane_(scene.membrane), table_(table), file_(file) {}

  void run() const {
    for (const Property& property : properties()) {
      if (property.places != nullptr) check(property);
    }
    check_values();
    if (membrane_.pump) check_pump();
  }

 private:
  [[nodiscard]] std::vector<Property> properties() const {
    const auto pointer = [](const auto& places) -> const PlaceScene* { return places ? &*places : nullptr; };
    return {{"membrane.capacitance_by_place", pointer(membrane_.capacitance_by_place), true},
            {"membrane.conductance_by_place", pointer(membrane_.conductance_by_place), true},
            {"membrane.bending_by_place", pointer(membrane_.bending_by_place), false},
            {"membrane.curvature_by_place", pointer(membrane_.curvature_by_place), false},
            {"membrane.pump", pointer(membrane_.pump), true}};
  }

  [[noreturn]] void refuse(std::string_view table, std::string_view key, const std::string& problem) const {
    refuse_key(table_, table, key, file_, problem);
  }

  void check(const Property& property) const {
    const auto refuse_table = [&](std::string_view key, const std::string& problem) {
      refuse(property.table, key, problem);
    };
    const std::string name = fmt::format("[{}]", property.table);
    if (property.is_electric) {
      if (!scene_.electric) refuse_table("kind", name + " has no effect without [electric]");
    } else if (!membrane_.mobile) {
      refuse_table("kind", name + " has no effect while \"mobile\" in [membrane] is false");
    }
    check_shape(property, name);
  }

  void check_shape(const Property& property, const std::string& name) const {
    const PlaceScene& places = *property.places;
    const int degree = scene_.numerics.order;
    for (const HarmonicMode& mode : places.modes) {
      if (mode.n <= degree) continue;
      refuse(property.table, "modes",
             fmt::format("\"modes\" in {} has the degree n = {}; accepted: at most the degree {} of [numerics]", name,
                         mode.n, degree));
    }
    if (places.kind != PlaceKind::cap) return;
    if (places.axis == Triple{}) {
      refuse(property.table, "axis",
             fmt::format("\"axis\" in {} is 0, 0, 0; accepted: a vector that is not zero", name));
    }
    if (places.angle_deg == 180.0) {
      refuse(property.table, "angle_deg", fmt::format("\"angle_deg\" in {} is 180; accepted: less", name));
    }
    const double truncation = place_truncation(places, degree);
    if (truncation <= largest_truncation) return;
    refuse(property.table, "width_deg",
           fmt::format("the edge of the cap in {} is wrong by {:.2g} of its step at the degree {} of [numerics]; "
                       "accepted: at most {:g}, by a wider \"width_deg\" or a higher degree",
                       name, truncation, degree, largest_truncation));
  }

  void check_values() const {
    const auto require_value = [&](const std::optional<PlaceScene>& places, std::string_view table, double value,
                                   const char* key) {
      if (places && value == 0.0) {
        refuse(table, "kind", fmt::format("[{}] has no effect: \"{}\" in [membrane] is 0", table, key));
      }
    };
    require_value(membrane_.conductance_by_place, "membrane.conductance_by_place", membrane_.conductance,
                  "conductance");
    require_value(membrane_.bending_by_place, "membrane.bending_by_place", membrane_.bending_modulus.value_or(0.0),
                  "bending_modulus");
    require_value(membrane_.curvature_by_place, "membrane.curvature_by_place", membrane_.spontaneous_curvature,
                  "spontaneous_curvature");
    require_sign(membrane_.capacitance_by_place, "membrane.capacitance_by_place", false);
    require_sign(membrane_.bending_by_place, "membrane.bending_by_place", false);
    require_sign(membrane_.conductance_by_place, "membrane.conductance_by_place", true);
  }

  /// @param may_vanish  but for what a cut cap falls below zero
  void require_sign(const std::optional<PlaceScene>& places, std::string_view table, bool may_vanish) const {
    if (!places) return;
    const int degree = scene_.numerics.order;
    const SphereTransform transform(degree, make_grid(2 * degree));
    const Vector factor = transform.synthesize(place_factor(*places, degree));
    const double least = factor.minCoeff();
    if (may_vanish ? least >= -largest_truncation * factor.maxCoeff() : least > 0.0) return;
    refuse(table, "kind",
           fmt::format("the factor in [{}] falls to {:.3g}; accepted: {} everywhere", table, least,
                       may_vanish ? ">= 0" : "> 0"));
  }

  void check_pump() const {
    if (has_averaged_field(scene_)) {
      refuse("membrane.pump", "current",
             "\"average\" in [electric.waveform] is true with [membrane.pump], whose current has a time of its own; "
             "accepted: false");
    }
    if (membrane_.pump->current == 0.0) {
      refuse("membrane.pump", "current", "\"current\" in [membrane.pump] is 0: it has no effect; accepted: any other");
    }
    if (membrane_.conductance == 0.0 && scene_.electric->initial_potential == InitialPotential::steady) {
      refuse("membrane.pump", "current",
             "a pump and a steady \"initial_Vm\" in [electric] with \"conductance\" 0 in [membrane], where the pump "
             "never comes to rest; accepted: a conductance > 0, or zero");
    }
  }

  const Scene& scene_;
  const MembraneScene& membrane_;
  const toml::table& table_;
  const std::string& file_;
};

}  // namespace

void check_places(const Scene& scene, const toml::table& table, const std::string& file) {
  if (has_places(scene)) PlaceChecks(scene, table, file).run();
}

}  // namespace vehd
