#pragma once

#include <optional>
#include <utility>

#include "bie/geometry/surface.hpp"
#include "bie/physics/effects/viscosity_contrast.hpp"
#include "bie/potentials/layer_operators.hpp"
#include "bie/sphere/symmetry.hpp"

namespace vehd {

/// Properties of a membrane that differ from place to place and ride on its material points: coefficients of a degree,
/// or values on a grid. An empty one is the same everywhere, as the parameters of the membrane say.
struct MembraneMaterial {
  Vector capacitance;            ///< C_m
  Vector conductance;            ///< G_m
  Vector pump_current;           ///< J_p, per area and outwards, where the waveform of the pump is 1; empty: no pump
  Vector bending_modulus;        ///< κ_B; there together with the next
  Vector spontaneous_curvature;  ///< c
};

/// Calls visit(Vector&) for each property that varies.
template <typename Material, typename Visit>
void for_each_property(Material& material, const Visit& visit) {
  for (auto* property : {&material.capacitance, &material.conductance, &material.pump_current,
                         &material.bending_modulus, &material.spontaneous_curvature}) {
    if (property->size() > 0) visit(*property);
  }
}

/// One frozen membrane as the physics sees it: the surface on the upsampled grid, where all products are formed, and
/// the layer operators on degree p. "Weighted" coefficients are those of J f (see LayerOperators).
struct Membrane {
  SphereTransform fine;  ///< degree p ↔ upsampled grid
  Surface surface;       ///< on the upsampled grid
  LayerOperators layers;
  double radius;                                ///< √(area/4π), of the sphere behind the preconditioners
  SymmetrySubspace subspace;                    ///< of the fields on it
  std::optional<ViscosityContrast> contrast{};  ///< empty where both fluids have the same viscosity
  MembraneMaterial material{};                  ///< what differs from place to place, on the upsampled grid

  /// Coefficients of J f from values on the upsampled grid.
  /// @param values  [n_points x n_fields] @return [n_coefficients x n_fields]
  [[nodiscard]] Matrix weighted(const Matrix& values) const {
    return fine.analyze(surface.area_element.asDiagonal() * values);
  }
  /// Velocity of the membrane, coefficients [n_coefficients x 3], from v_∞ + S[f]/μ_e, which it is between fluids of
  /// equal viscosity.
  [[nodiscard]] Matrix velocity(Matrix driven) const {
    return contrast ? contrast->velocity(driven) : std::move(driven);
  }
};

}  // namespace vehd
