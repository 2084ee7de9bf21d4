#include "bie/physics/electric.hpp"

#include <cmath>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/real_maps.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// J n×∇_γ f = f_1 x_2 − f_2 x_1, [n_points x 3].
Matrix weighted_rotated_gradient(const Surface& s, const SphereDerivatives& f) {
  return f.d1.col(0).asDiagonal() * s.tangent_2 - f.d2.col(0).asDiagonal() * s.tangent_1;
}

}  // namespace

double conductivity_contrast(const ElectricParameters& electric) {
  return (electric.conductivity_in - electric.conductivity_out) /
         (electric.conductivity_in + electric.conductivity_out);
}

double series_conductivity(const ElectricParameters& electric) {
  return electric.conductivity_in *
         (electric.conductivity_out / (electric.conductivity_in + electric.conductivity_out));
}

bool carries_charge(const ElectricParameters& electric) {
  return conductivity_contrast(electric) != 0.0 ||
         (electric.displacement_current && (!electric.averaged_frequency || electric.permittivity_ratio != 1.0));
}

Vector weighted_hypersingular(const Membrane& membrane, const Vector& potential) {
  const Surface& s = membrane.surface;
  const Matrix density =
      membrane.fine.analyze(weighted_rotated_gradient(s, membrane.fine.synthesize_gradient(potential)));
  const SphereDerivatives layer = membrane.fine.synthesize_gradient(membrane.layers.laplace_single.apply(density));
  return (layer.d1.cwiseProduct(s.tangent_2) - layer.d2.cwiseProduct(s.tangent_1)).rowwise().sum();
}

Vector weighted_field_flux(const Membrane& membrane, const Vector3& field) {
  return membrane.surface.area_element.cwiseProduct(membrane.surface.normal * field);
}

ElectricTraces electric_traces(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                               const SecondKindSolution& density, const Vector& of_others) {
  const double sum = electric.conductivity_in + electric.conductivity_out;
  const double eta = conductivity_contrast(electric);
  ElectricTraces traces;
  traces.flux_in = -(electric.conductivity_out / sum) * density.values;
  traces.flux_out = -(electric.conductivity_in / sum) * density.values;
  traces.charge = eta * density.values;
  const Vector weighted_charge = eta == 0.0 ? Vector() : Vector(eta * density.weighted);
  const Vector mean = mean_potential<double>({electric, membrane}, potential, weighted_charge, of_others);
  traces.potential_in = mean + 0.5 * potential;
  traces.potential_out = mean - 0.5 * potential;
  return traces;
}

namespace {

/// n·Σ_el = ε (E_n E − ½|E|² n) for E = −∇_γ φ − ∂φ/∂n n, Eqs. (3) and (15).
Matrix maxwell_traction(double permittivity, const Membrane& membrane, const Vector& potential, const Vector& flux) {
  const Surface& s = membrane.surface;
  const Matrix tangential = -surface_gradient(s, membrane.fine.synthesize_gradient(potential));
  const Eigen::ArrayXd normal = -flux.array();
  const Vector pressure = 0.5 * (normal.square() - tangential.rowwise().squaredNorm().array());
  return permittivity * (Vector(normal).asDiagonal() * tangential + pressure.asDiagonal() * s.normal);
}

}  // namespace

Matrix electric_force(double permittivity, const Membrane& membrane, const ElectricTraces& traces,
                      double permittivity_ratio) {
  return maxwell_traction(permittivity_ratio * permittivity, membrane, traces.potential_in, traces.flux_in) -
         maxwell_traction(permittivity, membrane, traces.potential_out, traces.flux_out);
}

PairSelection electric_pair_selection(const ElectricParameters& electric) {
  const bool charged = carries_charge(electric);
  return {.laplace_single = charged,
          .laplace_single_normal = charged,
          .laplace_double = true,
          .laplace_double_normal = true};
}

namespace {

/// Inverse of second_kind_operator on a sphere of any radius.
Vector second_kind_sphere_inverse(double eta, const Vector& weighted) {
  Vector result(weighted.size());
  for (int n = 0; n <= order_of(weighted.size()); ++n) {
    double eigenvalue = n == 0 ? 0.5 * (1.0 - eta) : 0.5 - eta / (2.0 * (2.0 * n + 1.0));
    // At η = 1 the mean of the density is free and that of the right-hand side zero: any nonzero number will do.
    if (n == 0 && eta >= 1.0) eigenvalue = 1.0;
    const Index first = coefficient_index(n, -n), count = 2 * n + 1;
    result.segment(first, count) = weighted.segment(first, count) / eigenvalue;
  }
  return result;
}

/// Coefficients of a right-hand side of Eq. (12); a mean that is only rounding is set to zero.
/// @param weighted_values  J rhs on the upsampled grid
Vector second_kind_right_side(const Membrane& membrane, const Vector& weighted_values) {
  Vector rhs = membrane.fine.analyze(weighted_values);
  // The eigenvalue ½(1 − η) of the mean would turn rounding into a net charge at large contrast.
  constexpr double kRounding = 1e-13;
  if (std::abs(rhs[0]) < kRounding * rhs.norm()) rhs[0] = 0.0;
  return rhs;
}

/// η_b times each density; empty if η_b is zero.
std::vector<Vector> charges_of(const std::vector<double>& contrasts, const std::vector<Vector>& weighted) {
  std::vector<Vector> charges;
  for (std::size_t b = 0; b < contrasts.size(); ++b) {
    charges.push_back(contrasts[b] == 0.0 ? Vector() : Vector(contrasts[b] * weighted[b]));
  }
  return charges;
}

std::vector<double> contrasts_of(const std::vector<ElectricMembrane>& membranes) {
  std::vector<double> contrasts;
  for (const ElectricMembrane& one : membranes) contrasts.push_back(conductivity_contrast(one.electric));
  return contrasts;
}

/// Eq. (12) of all membranes, each with its η. The unknowns are J g/R².
class DensityEquations {
 public:
  DensityEquations(std::vector<const Membrane*> membranes, std::vector<double> contrasts,
                   const Interaction& interaction)
      : membranes_(std::move(membranes)),
        contrasts_(std::move(contrasts)),
        interaction_(interaction),
        owned_(interaction.partition().local_indices(membranes_.size())) {
    std::vector<double> areas;
    for (const Membrane* membrane : membranes_) {
      entries_.add(membrane->subspace.n_coefficients(), 1, membrane->subspace.potentials());
      areas.push_back(membrane->radius * membrane->radius);
    }
    scale_ = entries_.spread(areas);
  }

  /// Weighted Σ_{b≠a} η_b S′_ab[g_b] on each membrane a; empty without others.
  [[nodiscard]] std::vector<Vector> fluxes_of_others(const std::vector<Vector>& weighted) const {
    if (interaction_.is_empty()) return std::vector<Vector>(membranes_.size());
    return interaction_.weighted_single_flux(charges_of(contrasts_, weighted));
  }

  /// Solves for J g of all membranes, coefficients.
  SolveReport solve(const std::vector<Vector>& weighted_rhs, double tolerance, std::vector<Vector>& weighted) const {
    std::vector<Vector> right_sides(membranes_.size());
    for (const std::size_t a : owned_) right_sides[a] = second_kind_right_side(*membranes_[a], weighted_rhs[a]);
    interaction_.gather_potentials(right_sides);
    const LinearMap map = [&](const Vector& unknowns) { return entries_.stack(left_side(densities_of(unknowns))); };
    const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
      std::vector<Vector> parts = entries_.fields<Vector>(residual);
      for (std::size_t a = 0; a < parts.size(); ++a) parts[a] = second_kind_sphere_inverse(contrasts_[a], parts[a]);
      return entries_.stack(parts).cwiseQuotient(scale_);
    };
    RecycledGcr solver(map, preconditioner, entries_.size());
    const RecycledGcr::Solution solution = solver.solve(entries_.stack(right_sides), {}, {tolerance, kMostIterations});
    weighted = densities_of(solution.x);
    return solution.report;
  }

 private:
  static constexpr int kMostIterations = 60;

  [[nodiscard]] std::vector<Vector> densities_of(const Vector& unknowns) const {
    return entries_.fields<Vector>(unknowns.cwiseProduct(scale_));
  }

  [[nodiscard]] std::vector<Vector> left_side(const std::vector<Vector>& weighted) const {
    std::vector<Vector> result(membranes_.size());
    const std::vector<Vector> of_others = fluxes_of_others(weighted);
    for_each_member(owned_, [&](std::size_t a) {
      result[a] = second_kind_operator<double>(*membranes_[a], contrasts_[a], weighted[a]);
      if (of_others[a].size() > 0) result[a] += of_others[a];
    });
    interaction_.gather_potentials(result);
    return result;
  }

  std::vector<const Membrane*> membranes_;
  std::vector<double> contrasts_;
  const Interaction& interaction_;
  std::vector<std::size_t> owned_;  // membranes of this rank
  StackedEntries entries_;
  Vector scale_;  // R² of each entry
};

std::vector<SecondKindSolution> solved(const std::vector<const Membrane*>& membranes,
                                       const std::vector<double>& contrasts, const Interaction& interaction,
                                       const std::vector<Vector>& weighted_rhs, double tolerance) {
  const DensityEquations equations(membranes, contrasts, interaction);
  std::vector<Vector> weighted;
  const SolveReport report = equations.solve(weighted_rhs, tolerance, weighted);
  const std::vector<Vector> of_others = equations.fluxes_of_others(weighted);
  std::vector<SecondKindSolution> result;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    SecondKindSolution& density = result.emplace_back(SecondKindSolution{weighted[a], {}, report});
    if (!interaction.partition().is_local(a)) continue;
    const Membrane& membrane = *membranes[a];
    Vector values = weighted_rhs[a];
    if (contrasts[a] != 0.0) {
      values -= membrane.fine.synthesize(contrasts[a] * membrane.layers.laplace_adjoint.apply(weighted[a]));
    }
    if (of_others[a].size() > 0) values -= membrane.fine.synthesize(of_others[a]);
    density.values = 2.0 * values.cwiseQuotient(membrane.surface.area_element);
  }
  return result;
}

}  // namespace

std::vector<Vector> weighted_fluxes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                    const std::vector<Vector>& potentials) {
  std::vector<Vector> fluxes(membranes.size());
  const std::vector<Vector> of_others = interaction.is_empty() ? fluxes : interaction.weighted_double_flux(potentials);
  for_each_member(interaction.partition().local_indices(membranes.size()), [&](std::size_t a) {
    const Membrane& membrane = membranes[a].membrane;
    fluxes[a] =
        weighted_field_flux(membrane, membranes[a].electric.field) + weighted_hypersingular(membrane, potentials[a]);
    if (of_others[a].size() > 0) fluxes[a] += membrane.fine.synthesize(of_others[a]);
  });
  return fluxes;
}

std::vector<SecondKindSolution> solve_second_kind(const std::vector<ElectricMembrane>& membranes,
                                                  const Interaction& interaction,
                                                  const std::vector<Vector>& weighted_rhs, double tolerance) {
  std::vector<const Membrane*> surfaces;
  for (const ElectricMembrane& one : membranes) surfaces.push_back(&one.membrane);
  return solved(surfaces, contrasts_of(membranes), interaction, weighted_rhs, tolerance);
}

SecondKindSolution solve_second_kind(const Membrane& membrane, double eta, const Vector& weighted_rhs,
                                     double tolerance) {
  return solved({&membrane}, {eta}, {}, {weighted_rhs}, tolerance).front();
}

std::vector<Vector> potentials_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                         const std::vector<Vector>& potentials,
                                         const std::vector<SecondKindSolution>& densities) {
  if (interaction.is_empty()) return std::vector<Vector>(membranes.size());
  std::vector<Vector> weighted;
  for (const SecondKindSolution& density : densities) weighted.push_back(density.weighted);
  std::vector<Vector> result = interaction.single_potential(charges_of(contrasts_of(membranes), weighted));
  const std::vector<Vector> jumps = interaction.double_potential(potentials);
  for (const std::size_t a : interaction.partition().local_indices(result.size())) result[a] -= jumps[a];
  return result;
}

}  // namespace vehd
