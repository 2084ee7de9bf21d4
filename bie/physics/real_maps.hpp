#pragma once

#include <vector>

#include "bie/physics/electric.hpp"
#include "bie/physics/interaction.hpp"
#include "bie/support/complex_columns.hpp"

/// Real linear maps, transforms and layers, applied to real fields or to both parts of complex ones.
namespace vehd {

/// Applies a linear map of real columns to each part of a field.
template <typename Scalar, typename Map>
FieldOf<Scalar> mapped(const Map& map, const FieldOf<Scalar>& field) {
  return from_parts<Scalar>(map(parts_of(field)));
}

/// Values on the upsampled grid, [n_points], from coefficients, [n_coefficients].
template <typename Scalar>
FieldOf<Scalar> values_of(const Membrane& membrane, const FieldOf<Scalar>& coefficients) {
  return mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.fine.synthesize(parts); }, coefficients);
}

/// Coefficients, [n_coefficients], from values on the upsampled grid, [n_points].
template <typename Scalar>
FieldOf<Scalar> coefficients_of(const Membrane& membrane, const FieldOf<Scalar>& values) {
  return mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.fine.analyze(parts); }, values);
}

/// Coefficients of J f from values of f.
template <typename Scalar>
FieldOf<Scalar> weighted(const Membrane& membrane, const FieldOf<Scalar>& values) {
  return mapped<Scalar>([&](const Matrix& parts) { return membrane.weighted(parts); }, values);
}

/// J S′[f] from J f, coefficients.
template <typename Scalar>
FieldOf<Scalar> adjoint(const Membrane& membrane, const FieldOf<Scalar>& weighted) {
  return mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.layers.laplace_adjoint.apply(parts); },
                        weighted);
}

/// (½ + η S′) on weighted coefficients: J g ↦ J (½ g + η S′[g]); the left side of Eq. (12). Its entry of degree 0 is
/// set to ½(1 − η) times that of J g (∫S′[g] = −½∫g), which the quadrature would only approximate.
/// @param weighted_density  coefficients of J g, [n_coefficients]
/// Source: paper Eq. (12), divided by η
template <typename Scalar>
FieldOf<Scalar> second_kind_operator(const Membrane& membrane, Scalar eta, const FieldOf<Scalar>& weighted_density) {
  FieldOf<Scalar> result = 0.5 * weighted_density;
  if (eta != 0.0) result += eta * adjoint<Scalar>(membrane, weighted_density);
  result[0] = 0.5 * (1.0 - eta) * weighted_density[0];
  return result;
}

/// J D′[V], values.
template <typename Scalar>
FieldOf<Scalar> hypersingular(const Membrane& membrane, const FieldOf<Scalar>& potential) {
  return mapped<Scalar>(
      [&](const Matrix& parts) -> Matrix {
        Matrix values(membrane.surface.n_points(), parts.cols());
        for (Index part = 0; part < parts.cols(); ++part) {
          values.col(part) = weighted_hypersingular(membrane, parts.col(part));
        }
        return values;
      },
      potential);
}

/// J E·n, values.
template <typename Scalar>
FieldOf<Scalar> applied_flux(const ElectricMembrane& of) {
  return weighted_field_flux(of.membrane, of.electric.field).cast<Scalar>();
}

/// The mean of φ_i and φ_e, coefficients: −E·x + S[f] − D[V] plus the contribution of others.
/// @param weighted_jump  J f, f = E_e − E_i; empty if it is zero
/// @param of_others      contribution of other membranes, coefficients, or empty
/// Source: paper Eq. (11)
template <typename Scalar>
FieldOf<Scalar> mean_potential(const ElectricMembrane& of, const FieldOf<Scalar>& potential,
                               const FieldOf<Scalar>& weighted_jump, const FieldOf<Scalar>& of_others) {
  const Membrane& membrane = of.membrane;
  const Vector applied = membrane.fine.analyze(-(membrane.surface.position * of.electric.field));
  FieldOf<Scalar> mean =
      applied.cast<Scalar>() -
      mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.layers.laplace_double.apply(parts); },
                     potential);
  if (weighted_jump.size() > 0) {
    mean += mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.layers.laplace_single.apply(parts); },
                           weighted_jump);
  }
  if (of_others.size() > 0) mean += of_others;
  return mean;
}

using Layer = std::vector<Vector> (Interaction::*)(const std::vector<Vector>&) const;

/// Contribution of the other membranes to each one; empty without others.
template <typename Scalar>
std::vector<FieldOf<Scalar>> of_others(const Interaction& interaction, Layer layer,
                                       const std::vector<FieldOf<Scalar>>& densities) {
  if (interaction.is_empty()) return std::vector<FieldOf<Scalar>>(densities.size());
  if constexpr (std::is_same_v<Scalar, double>) {
    return (interaction.*layer)(densities);
  } else {
    std::vector<Vector> real, imaginary;
    for (const FieldOf<Scalar>& density : densities) {
      real.emplace_back(density.real());
      imaginary.emplace_back(density.imag());
    }
    const std::vector<Vector> of_real = (interaction.*layer)(real), of_imaginary = (interaction.*layer)(imaginary);
    std::vector<FieldOf<Scalar>> result;
    for (std::size_t a = 0; a < densities.size(); ++a) {
      result.emplace_back(of_real[a] + Scalar(0.0, 1.0) * of_imaginary[a]);
    }
    return result;
  }
}

/// Interaction::gather_potentials of real or complex fields.
template <typename Scalar>
void gather(const Interaction& interaction, std::vector<FieldOf<Scalar>>& fields) {
  if (interaction.is_empty()) return;
  std::vector<Matrix> parts;
  for (const FieldOf<Scalar>& field : fields) parts.push_back(parts_of(field));
  interaction.gather_potentials(parts);
  for (std::size_t a = 0; a < fields.size(); ++a) fields[a] = from_parts<Scalar>(parts[a]);
}

}  // namespace vehd
