#pragma once

#include <optional>
#include <utility>

#include "bie/geometry/surface.hpp"
#include "bie/physics/effects/viscosity_contrast.hpp"
#include "bie/potentials/layer_operators.hpp"
#include "bie/sphere/symmetry.hpp"

namespace vehd {

/// Spatially varying properties of a membrane, fixed to its material points: coefficients of a degree, or values on a
/// grid. An empty one is uniform, with the value in the parameters of the membrane.
struct MembraneMaterial {
  Vector capacitance;            ///< C_m
  Vector conductance;            ///< G_m
  Vector pump_current;           ///< J_p, per area and outwards, when the waveform of the pump is 1; empty: no pump
  Vector bending_modulus;        ///< κ_B; given together with the next
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

/// One frozen membrane: the surface on the upsampled grid, on which all products are formed, and the layer operators of
/// degree p. "Weighted" coefficients are those of J f (see LayerOperators).
struct Membrane {
  SphereTransform fine;  ///< degree p ↔ upsampled grid
  Surface surface;       ///< on the upsampled grid
  LayerOperators layers;
  double radius;                                ///< √(area/4π), of the sphere in the preconditioners
  SymmetrySubspace subspace;                    ///< symmetries of the fields on it
  std::optional<ViscosityContrast> contrast{};  ///< empty if both fluids have the same viscosity
  MembraneMaterial material{};                  ///< spatially varying properties, on the upsampled grid

  /// Coefficients of J f from values on the upsampled grid.
  /// @param values  [n_points x n_fields] @return [n_coefficients x n_fields]
  [[nodiscard]] Matrix weighted(const Matrix& values) const {
    return fine.analyze(surface.area_element.asDiagonal() * values);
  }
  /// Velocity of the membrane, coefficients [n_coefficients x 3], from v_∞ + S[f]/μ_e; equal to that if both fluids
  /// have the same viscosity.
  [[nodiscard]] Matrix velocity(Matrix driven) const {
    return contrast ? contrast->velocity(driven) : std::move(driven);
  }
};

}  // namespace vehd
