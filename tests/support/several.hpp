#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"
#include "bie/physics/electric.hpp"
#include "tests/support/membrane.hpp"

namespace vehd::testing {

/// Several frozen membranes of one degree with their layers on one another.
struct SeveralMembranes {
  Space space;
  std::vector<Matrix> positions;
  std::vector<Membrane> membranes;
  Interaction interaction;

  SeveralMembranes(int order, std::vector<Matrix> coefficients, const LayerSelection& own, const PairSelection& pairs)
      : space(order), positions(std::move(coefficients)), membranes(made(own)), interaction(interaction_of(pairs)) {}

  [[nodiscard]] std::size_t count() const { return positions.size(); }

  /// All vesicles between the same fluids.
  [[nodiscard]] std::vector<ElectricMembrane> in_field(const ElectricParameters& electric) const {
    std::vector<ElectricMembrane> all;
    for (const Membrane& membrane : membranes) all.push_back({electric, membrane});
    return all;
  }

  /// The same with membranes that charge.
  [[nodiscard]] std::vector<ChargingMembrane> charging(const ElectricParameters& electric,
                                                       const std::vector<ChargingParameters>& of_each) const {
    std::vector<ChargingMembrane> all;
    for (std::size_t a = 0; a < count(); ++a) all.push_back({{electric, membranes[a]}, of_each[a]});
    return all;
  }

  /// A zero field on each membrane.
  [[nodiscard]] std::vector<Vector> zeros() const {
    std::vector<Vector> all;
    for (const Matrix& position : positions) all.emplace_back(Vector::Zero(position.rows()));
    return all;
  }

 private:
  [[nodiscard]] std::vector<Membrane> made(const LayerSelection& own) const {
    std::vector<Membrane> all;
    for (const Matrix& position : positions) all.push_back(make_membrane(space, position, own));
    return all;
  }
  [[nodiscard]] Interaction interaction_of(const PairSelection& pairs) const {
    std::vector<InteractingMembrane> all;
    for (const Matrix& position : positions) all.push_back({position, space.coarse, pairs});
    Instruments instruments;
    return {all, {}, instruments};
  }
};

constexpr PairSelection kLaplacePairs{true, true, true, true};

/// ∫f dA from values on the upsampled grid.
inline Vector3 total(const Membrane& membrane, const Matrix& values) {
  return values.transpose() * membrane.surface.quadrature;
}

}  // namespace vehd::testing
