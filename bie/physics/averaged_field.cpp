#include "bie/physics/averaged_field.hpp"

#include <numbers>
#include <utility>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/complex_columns.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

using Complex = std::complex<double>;

double angular_frequency(double frequency) { return 2.0 * std::numbers::pi * frequency; }

/// A real field: its imaginary part is zero.
Matrix from_real(const Vector& real) {
  Matrix z = Matrix::Zero(real.size(), 2);
  z.col(0) = real;
  return z;
}

/// weighted_hypersingular of both parts.
Matrix weighted_hypersingular_of(const Membrane& membrane, const Matrix& potential) {
  Matrix result(membrane.surface.n_points(), 2);
  for (Index part = 0; part < 2; ++part) result.col(part) = weighted_hypersingular(membrane, potential.col(part));
  return result;
}

/// A map of the real fields of all membranes, of the real parts and of the imaginary parts.
template <typename Map>
std::vector<Matrix> of_parts(const Map& map, const std::vector<Matrix>& fields) {
  std::vector<Matrix> result(fields.size());
  for (Index part = 0; part < 2; ++part) {
    std::vector<Vector> real;
    for (const Matrix& field : fields) real.emplace_back(field.size() == 0 ? Vector() : Vector(field.col(part)));
    const std::vector<Vector> mapped = map(real);
    for (std::size_t a = 0; a < fields.size(); ++a) {
      if (part == 0) result[a].resize(mapped[a].size(), 2);
      result[a].col(part) = mapped[a];
    }
  }
  return result;
}

/// Product at every point.
Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows(), 2);
  result << a.col(0).cwiseProduct(b.col(0)) - a.col(1).cwiseProduct(b.col(1)),
      a.col(0).cwiseProduct(b.col(1)) + a.col(1).cwiseProduct(b.col(0));
  return result;
}

/// ChargingEquation for complex amplitudes: y in place of a, and b = 0.
class AmplitudeEquation {
 public:
  AmplitudeEquation(const ElectricMembrane& of, const ChargingParameters& charging)
      : electric_(of.electric), membrane_(of.membrane), conductivities_(complex_conductivities(of.electric)) {
    contrast_ = carries_charge(electric_) ? conductivities_.contrast() : 0.0;
    const bool varies = membrane_.material.capacitance.size() > 0 || membrane_.material.conductance.size() > 0;
    Matrix admittances;
    if (varies) admittances = admittances_of(charging);
    const Complex admittance = varies ? mean(admittances) : membrane_admittance(charging, frequency());
    const Complex series = conductivities_.series();
    const double size = std::abs(admittance) + std::abs(series) / membrane_.radius;
    storage_ = admittance / size;
    conduction_ = series / size;
    if (varies) varying_storage_ = admittances / size;
  }

  [[nodiscard]] const Membrane& membrane() const { return membrane_; }
  [[nodiscard]] const ElectricParameters& electric() const { return electric_; }
  [[nodiscard]] const ComplexConductivities& conductivities() const { return conductivities_; }
  [[nodiscard]] Complex contrast() const { return contrast_; }
  [[nodiscard]] Complex conduction() const { return conduction_; }
  /// Of a fluid that lets no current through.
  [[nodiscard]] bool insulates() const { return conduction_ == 0.0; }

  /// J g = J y V/κ, coefficients; not where a fluid insulates.
  [[nodiscard]] Matrix weighted_density(const Matrix& potential) const {
    const auto [factor, weighted] = stored(potential);
    return times(factor / conduction_, weighted);
  }
  /// J ηg, empty where there is none.
  [[nodiscard]] Matrix weighted_charge(const Matrix& potential) const {
    return contrast_ == 0.0 ? Matrix() : times(contrast_, weighted_density(potential));
  }

  /// What V does on its own membrane, coefficients.
  [[nodiscard]] Matrix own(const Matrix& potential) const {
    const SphereTransform& fine = membrane_.fine;
    const auto [factor, weighted] = stored(potential);
    Matrix second_kind = 0.5 * weighted;
    if (contrast_ != 0.0) second_kind += times(contrast_, membrane_.layers.laplace_adjoint.apply(weighted));
    Matrix result = times(factor, second_kind);
    result -= times(conduction_, fine.analyze(weighted_hypersingular_of(membrane_, potential)));
    // No net current: ∫ yV dA = 0.
    result.row(0) = times(factor, weighted.topRows(1));
    return result;
  }

  [[nodiscard]] Matrix sphere_inverse(const Matrix& residual) const {
    const double radius = membrane_.radius;
    Matrix result(residual.rows(), 2);
    for (int n = 0; n <= membrane_.fine.order(); ++n) {
      const double odd = 2.0 * n + 1.0;
      const Complex second_kind = n == 0 ? Complex(1.0) : 0.5 - contrast_ / (2.0 * odd);
      const Complex eigenvalue =
          storage_ * radius * radius * second_kind + conduction_ * radius * (n * (n + 1.0) / odd);
      const Index first = coefficient_index(n, -n), count = 2 * n + 1;
      result.middleRows(first, count) = times(1.0 / eigenvalue, residual.middleRows(first, count));
    }
    return result;
  }

  /// Of the field.
  [[nodiscard]] Matrix right_side() const {
    Matrix result = times(conduction_, membrane_.fine.analyze(from_real(flux_of_field())));
    result.row(0).setZero();
    return result;
  }

  /// J E·n on the upsampled grid.
  [[nodiscard]] Vector flux_of_field() const { return weighted_field_flux(membrane_, electric_.field); }

 private:
  [[nodiscard]] double frequency() const { return *electric_.averaged_frequency; }

  /// y of every point of the upsampled grid.
  [[nodiscard]] Matrix admittances_of(const ChargingParameters& charging) const {
    Matrix result(membrane_.surface.n_points(), 2);
    result << conductance_of(charging, membrane_), angular_frequency(frequency()) * capacitance_of(charging, membrane_);
    return result;
  }

  /// Over the area.
  [[nodiscard]] Complex mean(const Matrix& values) const {
    const Vector& area = membrane_.surface.quadrature;
    return Complex(values.col(0).dot(area), values.col(1).dot(area)) / area.sum();
  }

  /// A factor and coefficients: their product is that of J yV over the size.
  struct Stored {
    Complex factor;
    Matrix weighted;
  };
  [[nodiscard]] Stored stored(const Matrix& potential) const {
    const Matrix values = membrane_.fine.synthesize(potential);
    if (varying_storage_.size() == 0) return {storage_, membrane_.weighted(values)};
    return {1.0, membrane_.weighted(product(varying_storage_, values))};
  }

  const ElectricParameters& electric_;
  const Membrane& membrane_;
  ComplexConductivities conductivities_;
  Complex contrast_, storage_, conduction_;
  Matrix varying_storage_;  // of every point, and storage_ its mean; empty where it is the same everywhere
};

/// The equations of all membranes.
class AmplitudeEquations {
 public:
  AmplitudeEquations(const std::vector<ElectricMembrane>& membranes, const std::vector<ChargingParameters>& charging,
                     const Interaction* interaction)
      : interaction_(interaction) {
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      equations_.emplace_back(membranes[a], charging[a]);
      if (membranes.size() > 1 && equations_.back().insulates()) {
        throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
      }
    }
  }

  [[nodiscard]] std::size_t count() const { return equations_.size(); }
  /// Those of the membranes of this rank.
  [[nodiscard]] std::vector<std::size_t> own() const {
    return interaction_ == nullptr ? Shares().own(count()) : interaction_->shares().own(count());
  }
  [[nodiscard]] const AmplitudeEquation& operator[](std::size_t a) const { return equations_[a]; }

  [[nodiscard]] std::vector<Matrix> charges(const std::vector<Matrix>& potentials) const {
    std::vector<Matrix> result(count());
    for (const std::size_t b : own()) result[b] = equations_[b].weighted_charge(potentials[b]);
    return result;
  }

  /// J n·∇ of the potentials of all others, without the single layers and of the single layers alone; coefficients.
  [[nodiscard]] std::vector<Matrix> double_fluxes_of_others(const std::vector<Matrix>& potentials) const {
    return of_parts([&](const std::vector<Vector>& f) { return interaction_->weighted_double_flux(f); }, potentials);
  }
  [[nodiscard]] std::vector<Matrix> single_fluxes_of_others(const std::vector<Matrix>& charges) const {
    return of_parts([&](const std::vector<Vector>& f) { return interaction_->weighted_single_flux(f); }, charges);
  }
  /// Σ_b S_ab[q_b] − D_ab[V_b] of b ≠ a, coefficients.
  [[nodiscard]] std::vector<Matrix> potentials_of_others(const std::vector<Matrix>& potentials,
                                                         const std::vector<Matrix>& charges) const {
    std::vector<Matrix> result =
        of_parts([&](const std::vector<Vector>& f) { return interaction_->single_potential(f); }, charges);
    const std::vector<Matrix> jumps =
        of_parts([&](const std::vector<Vector>& f) { return interaction_->double_potential(f); }, potentials);
    for (const std::size_t a : own()) result[a] -= jumps[a];
    return result;
  }

  [[nodiscard]] std::vector<Matrix> left_side(const std::vector<Matrix>& potentials) const {
    std::vector<Matrix> result(count());
    for (const std::size_t a : own()) result[a] = equations_[a].own(potentials[a]);
    if (interaction_ == nullptr) return result;
    const std::vector<Matrix> single = single_fluxes_of_others(charges(potentials));
    const std::vector<Matrix> doubles = double_fluxes_of_others(potentials);
    for (const std::size_t a : own()) result[a] += times(equations_[a].conduction(), single[a] - doubles[a]);
    interaction_->gather_potentials(result);
    return result;
  }

 private:
  const Interaction* interaction_;
  std::vector<AmplitudeEquation> equations_;
};

/// Real vectors as a solver sees complex amplitudes: the real part of the first membrane, its imaginary part, …
std::vector<Vector> split(const std::vector<Matrix>& fields) {
  std::vector<Vector> parts;
  for (const Matrix& field : fields) {
    for (Index part = 0; part < 2; ++part) parts.emplace_back(field.col(part));
  }
  return parts;
}

std::vector<Matrix> side_by_side(const std::vector<Vector>& parts) {
  std::vector<Matrix> fields;
  for (std::size_t i = 0; i < parts.size(); i += 2) {
    fields.emplace_back(parts[i].size(), 2) << parts[i], parts[i + 1];
  }
  return fields;
}

/// V of all membranes. The unknowns are V/R: what a field of one size makes of membranes of any size.
std::vector<Matrix> solve_potentials(const AmplitudeEquations& equations, double tolerance, SolveReport& report) {
  std::vector<Index> sizes;
  std::vector<std::vector<Index>> entries;
  std::vector<double> radii;
  std::vector<Matrix> right_sides;
  for (std::size_t a = 0; a < equations.count(); ++a) {
    const Membrane& membrane = equations[a].membrane();
    right_sides.push_back(equations[a].right_side());
    for (int part = 0; part < 2; ++part) {
      sizes.push_back(n_coefficients(membrane.fine.order()));
      entries.push_back(membrane.subspace.potentials());
      radii.push_back(membrane.radius);
    }
  }
  const StackedEntries stacked(std::move(sizes), std::move(entries));
  const Vector scale = stacked.spread(radii);
  const LinearMap map = [&](const Vector& unknowns) {
    return stacked.stack(split(equations.left_side(side_by_side(stacked.parts(unknowns.cwiseProduct(scale))))));
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<Matrix> fields = side_by_side(stacked.parts(residual));
    for (std::size_t a = 0; a < fields.size(); ++a) fields[a] = equations[a].sphere_inverse(fields[a]);
    return stacked.stack(split(fields)).cwiseQuotient(scale);
  };
  // As many as for two real problems.
  constexpr int kMostIterations = 120;
  RecycledGcr solver(map, preconditioner, stacked.size());
  const RecycledGcr::Solution solution =
      solver.solve(stacked.stack(split(right_sides)), {}, {tolerance, kMostIterations});
  report = solution.report;
  return side_by_side(stacked.parts(solution.x.cwiseProduct(scale)));
}

/// g of one membrane: coefficients of J g and values on the upsampled grid.
struct ComplexDensity {
  Matrix weighted, values;
};

/// g = 2 (E·n + D′[V] − ηS′[g]) with the g = yV/κ of the solve on the right, see solve_second_kind.
/// @param of_others  J n·∇ of what other membranes do, double layers less single layers, coefficients; or empty
ComplexDensity density_of(const AmplitudeEquation& equation, const Matrix& potential, const Matrix& of_others) {
  const Membrane& membrane = equation.membrane();
  ComplexDensity density{equation.weighted_density(potential), {}};
  Matrix values = from_real(equation.flux_of_field()) + weighted_hypersingular_of(membrane, potential);
  if (of_others.size() > 0) values += membrane.fine.synthesize(of_others);
  if (const Complex contrast = equation.contrast(); contrast != 0.0) {
    values -= membrane.fine.synthesize(times(contrast, membrane.layers.laplace_adjoint.apply(density.weighted)));
  }
  density.values = 2.0 * membrane.surface.area_element.cwiseInverse().asDiagonal() * values;
  return density;
}

/// Beside a fluid that insulates no current flows and V_m is zero: the density is that of dc.
ComplexDensity insulated_density(const AmplitudeEquation& equation, double tolerance, SolveReport& report) {
  const SecondKindSolution solution =
      solve_second_kind(equation.membrane(), equation.contrast().real(), equation.flux_of_field(), tolerance, {});
  const int iterations = report.iterations;
  report = solution.report;
  report.iterations += iterations;
  return {from_real(solution.weighted), from_real(solution.values)};
}

/// @param of_others  potential of other membranes on this one, coefficients; or empty
AveragedField field_of(const AmplitudeEquation& equation, const Matrix& potential, const ComplexDensity& density,
                       const Matrix& of_others) {
  const Membrane& membrane = equation.membrane();
  const ElectricParameters& electric = equation.electric();
  const ComplexConductivities& k = equation.conductivities();
  const Complex sum = k.inside + k.outside;
  const Matrix flux_in = times(-k.outside / sum, density.values);
  const Matrix flux_out = times(-k.inside / sum, density.values);
  const Matrix charge = times(equation.contrast(), density.values);
  const Vector applied = membrane.fine.analyze(-(membrane.surface.position * electric.field));
  Matrix mean = from_real(applied) - membrane.layers.laplace_double.apply(potential);
  if (equation.contrast() != 0.0) {
    mean += membrane.layers.laplace_single.apply(times(equation.contrast(), density.weighted));
  }
  if (of_others.size() > 0) mean += of_others;
  AveragedField field{potential, membrane.fine.analyze(charge), Matrix::Zero(membrane.surface.n_points(), 3)};
  for (Index part = 0; part < 2; ++part) {
    const Vector v = potential.col(part);
    const ElectricTraces traces{mean.col(part) + 0.5 * v, mean.col(part) - 0.5 * v, flux_in.col(part),
                                flux_out.col(part), charge.col(part)};
    // Means over a period of products: half the product of the real parts and half that of the imaginary parts.
    field.force += 0.5 * electric_force(electric.permittivity, membrane, traces, electric.permittivity_ratio);
  }
  return field;
}

}  // namespace

ComplexConductivities complex_conductivities(const ElectricParameters& electric) {
  ComplexConductivities k{electric.conductivity_in, electric.conductivity_out};
  if (!electric.displacement_current) return k;
  const double of_permittivity = angular_frequency(*electric.averaged_frequency) * electric.permittivity;
  k.inside += Complex(0.0, of_permittivity * electric.permittivity_ratio);
  k.outside += Complex(0.0, of_permittivity);
  return k;
}

std::complex<double> membrane_admittance(const ChargingParameters& charging, double frequency) {
  return {charging.conductance, angular_frequency(frequency) * charging.capacitance};
}

AveragedFields solve_averaged_fields(const std::vector<ElectricMembrane>& membranes,
                                     const std::vector<ChargingParameters>& charging, const Interaction* interaction,
                                     double tolerance) {
  const AmplitudeEquations equations(membranes, charging, interaction);
  AveragedFields result;
  const std::vector<Matrix> potentials = solve_potentials(equations, tolerance, result.report);
  std::vector<Matrix> fluxes(membranes.size()), of_others(membranes.size());
  if (interaction != nullptr) {
    const std::vector<Matrix> charges = equations.charges(potentials);
    fluxes = equations.double_fluxes_of_others(potentials);
    const std::vector<Matrix> single = equations.single_fluxes_of_others(charges);
    for (const std::size_t a : equations.own()) fluxes[a] -= single[a];
    of_others = equations.potentials_of_others(potentials, charges);
  }
  result.membranes.resize(membranes.size());
  for (const std::size_t a : equations.own()) {
    const AmplitudeEquation& equation = equations[a];
    const ComplexDensity density = equation.insulates() ? insulated_density(equation, tolerance, result.report)
                                                        : density_of(equation, potentials[a], fluxes[a]);
    result.membranes[a] = field_of(equation, potentials[a], density, of_others[a]);
  }
  return result;
}

}  // namespace vehd
