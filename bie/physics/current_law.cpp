#include "bie/physics/current_law.hpp"

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/real_maps.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

Vector capacitance_of(const ChargingParameters& charging, const Membrane& membrane) {
  const Vector& varies = membrane.material.capacitance;
  return varies.size() > 0 ? varies : Vector(Vector::Constant(membrane.surface.n_points(), charging.capacitance));
}

Vector conductance_of(const ChargingParameters& charging, const Membrane& membrane) {
  const Vector& varies = membrane.material.conductance;
  return varies.size() > 0 ? varies : Vector(Vector::Constant(membrane.surface.n_points(), charging.conductance));
}

MembraneCurrent membrane_current(const ChargingMembrane& of, const Vector& poration) {
  const auto& [electric, membrane] = of.in_field;
  MembraneCurrent current{conductance_of(of.charging, membrane), Vector::Zero(membrane.surface.n_points())};
  if (of.reaction != nullptr && poration.size() > 0) {
    current.conductance += Vector(membrane.fine.synthesize(poration)).unaryExpr([&](double s) {
      return of.reaction->conductance(s).value;
    });
  }
  if (membrane.material.pump_current.size() > 0) current.constant = electric.pump * membrane.material.pump_current;
  return current;
}

Vector current_through(const Membrane& membrane, const MembraneCurrent& current, const Vector& potential) {
  return current.conductance.cwiseProduct(Vector(membrane.fine.synthesize(potential))) + current.constant;
}

namespace {

/// The equation of one membrane, weighted by J and divided by |mean of a| + |κ|/R. Coefficients of degree p.
template <typename Scalar>
class LawEquation {
 public:
  using Field = FieldOf<Scalar>;

  /// Both must outlive it.
  LawEquation(const ElectricMembrane& of, const CurrentLaw<Scalar>& law) : of_(of), membrane_(of.membrane), law_(law) {
    const Vector& area = membrane_.surface.quadrature;
    const Scalar mean = law.a.cwiseProduct(area.cast<Scalar>()).sum() / area.sum();
    size_ = std::abs(mean) + std::abs(law.series()) / membrane_.radius;
    storage_ = mean / size_;
    conduction_ = law.series() / size_;
  }

  /// κ over that divisor.
  [[nodiscard]] Scalar conduction() const { return conduction_; }
  [[nodiscard]] bool stores() const { return storage_ != 0.0; }

  /// Left side without the terms of other membranes.
  [[nodiscard]] Field self_terms(const Field& potential) const {
    Field result = Field::Zero(potential.size());
    Scalar mean = potential[0];
    if (stores()) {
      const Field stored = weighted<Scalar>(membrane_, of_potential(potential)) / size_;
      result = second_kind_operator<Scalar>(membrane_, law_.contrast(), stored);
      mean = stored[0];
    }
    if (conduction_ != 0.0) {
      result -= conduction_ * coefficients_of<Scalar>(membrane_, hypersingular<Scalar>(membrane_, potential));
    }
    result[0] = mean;
    return result;
  }

  /// Inverse of `self_terms` on the sphere of the same area, with the mean of a in place of a.
  [[nodiscard]] Field sphere_inverse(const Field& residual) const {
    const double radius = membrane_.radius;
    Field result(residual.size());
    for (int n = 0; n <= membrane_.fine.order(); ++n) {
      const double odd = 2.0 * n + 1.0;
      const Scalar second_kind = n == 0 ? Scalar(1.0) : 0.5 - law_.contrast() / (2.0 * odd);
      Scalar eigenvalue = storage_ * radius * radius * second_kind + conduction_ * (radius * n * (n + 1.0) / odd);
      if (eigenvalue == 0.0) eigenvalue = 1.0;
      const Index first = coefficient_index(n, -n), count = 2 * n + 1;
      result.segment(first, count) = residual.segment(first, count) / eigenvalue;
    }
    return result;
  }

  /// Terms of the applied field and of s_i and s_e.
  [[nodiscard]] Field right_side() const {
    Field rhs = conduction_ * coefficients_of<Scalar>(membrane_, applied_flux<Scalar>(of_));
    const Field uneven = law_.share_in() * law_.s_in - law_.share_out() * law_.s_out;
    if (!uneven.isZero(0.0)) rhs += (0.5 / size_) * weighted<Scalar>(membrane_, uneven);
    const Field given = given_jump();
    if (!given.isZero(0.0)) rhs -= adjoint<Scalar>(membrane_, weighted<Scalar>(membrane_, given) / size_);
    rhs[0] = stores() ? weighted<Scalar>(membrane_, law_.s_in)[0] / size_ : Scalar(0.0);
    return rhs;
  }

  /// J (E_e − E_i) for s = 0; empty if it is zero.
  [[nodiscard]] Field weighted_jump_of(const Field& potential) const {
    if (law_.contrast() == 0.0 || !stores()) return {};
    return weighted<Scalar>(membrane_, (law_.contrast() / law_.series()) * of_potential(potential));
  }
  /// J (E_e − E_i) for V = 0; empty if it is zero.
  [[nodiscard]] Field weighted_jump_given() const {
    const Field given = given_jump();
    if (given.isZero(0.0)) return {};
    return weighted<Scalar>(membrane_, given / law_.series());
  }

 private:
  /// κ(E_e − E_i) for V = 0.
  [[nodiscard]] Field given_jump() const { return law_.share_in() * law_.s_in + law_.share_out() * law_.s_out; }
  /// aV.
  [[nodiscard]] Field of_potential(const Field& potential) const {
    return law_.a.cwiseProduct(values_of<Scalar>(membrane_, potential));
  }

  const ElectricMembrane& of_;
  const Membrane& membrane_;
  const CurrentLaw<Scalar>& law_;
  double size_ = 1.0;
  Scalar storage_, conduction_;
};

/// The equations of all membranes.
template <typename Scalar>
class LawEquations {
 public:
  using Field = FieldOf<Scalar>;

  LawEquations(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
               const std::vector<CurrentLaw<Scalar>>& laws)
      : interaction_(interaction), owned_(interaction.partition().local_indices(laws.size())) {
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      const LawEquation<Scalar>& one = of_each_.emplace_back(membranes[b].in_field, laws[b]);
      if (membranes.size() > 1 && one.conduction() == 0.0 && one.stores()) {
        throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
      }
    }
  }

  [[nodiscard]] std::vector<Field> left_side(const std::vector<Field>& potentials) const {
    std::vector<Field> result(potentials.size());
    for_each_member(owned_, [&](std::size_t a) { result[a] = of_each_[a].self_terms(potentials[a]); });
    if (interaction_.is_empty()) return result;
    const std::vector<Field> jumps =
        of_owned([&](std::size_t b) { return of_each_[b].weighted_jump_of(potentials[b]); });
    const std::vector<Field> of_jumps = of_others<Scalar>(interaction_, &Interaction::weighted_single_flux, jumps);
    const std::vector<Field> of_potentials =
        of_others<Scalar>(interaction_, &Interaction::weighted_double_flux, potentials);
    for (const std::size_t a : owned_) result[a] += of_each_[a].conduction() * (of_jumps[a] - of_potentials[a]);
    gather<Scalar>(interaction_, result);
    return result;
  }

  [[nodiscard]] std::vector<Field> right_side() const {
    std::vector<Field> result = of_owned([&](std::size_t a) { return of_each_[a].right_side(); });
    if (interaction_.is_empty()) return result;
    const std::vector<Field> of_jumps =
        of_others<Scalar>(interaction_, &Interaction::weighted_single_flux,
                          of_owned([&](std::size_t b) { return of_each_[b].weighted_jump_given(); }));
    for (const std::size_t a : owned_) result[a] -= of_each_[a].conduction() * of_jumps[a];
    gather<Scalar>(interaction_, result);
    return result;
  }

  [[nodiscard]] std::vector<Field> sphere_inverse(std::vector<Field> residuals) const {
    for (std::size_t a = 0; a < residuals.size(); ++a) residuals[a] = of_each_[a].sphere_inverse(residuals[a]);
    return residuals;
  }

 private:
  template <typename Make>
  [[nodiscard]] std::vector<Field> of_owned(const Make& make) const {
    std::vector<Field> result(of_each_.size());
    for (const std::size_t a : owned_) result[a] = make(a);
    return result;
  }

  const Interaction& interaction_;
  std::vector<std::size_t> owned_;  // membranes of this rank
  std::vector<LawEquation<Scalar>> of_each_;
};

/// V/R of all membranes as one real vector.
template <typename Scalar>
class StackedPotentials {
 public:
  using Field = FieldOf<Scalar>;

  explicit StackedPotentials(const std::vector<ChargingMembrane>& membranes) {
    constexpr Index kParts = std::is_same_v<Scalar, double> ? 1 : 2;
    std::vector<double> radii;
    for (const ChargingMembrane& one : membranes) {
      const SymmetrySubspace& subspace = one.in_field.membrane.subspace;
      std::vector<Index> entries;
      for (Index part = 0; part < kParts; ++part) {
        for (const Index i : subspace.potentials()) entries.push_back(part * subspace.n_coefficients() + i);
      }
      entries_.add(subspace.n_coefficients(), kParts, std::move(entries));
      radii.push_back(one.in_field.membrane.radius);
    }
    radius_ = entries_.spread(radii);
  }

  [[nodiscard]] Index size() const { return entries_.size(); }

  [[nodiscard]] Vector stack(const std::vector<Field>& fields) const {
    std::vector<Matrix> parts;
    for (const Field& field : fields) parts.push_back(parts_of(field));
    return entries_.stack(parts);
  }
  [[nodiscard]] std::vector<Field> fields(const Vector& stacked) const {
    std::vector<Field> result;
    for (const Matrix& parts : entries_.template fields<Matrix>(stacked)) result.push_back(from_parts<Scalar>(parts));
    return result;
  }

  [[nodiscard]] Vector over_radius(const std::vector<Field>& potentials) const {
    return stack(potentials).cwiseQuotient(radius_);
  }
  [[nodiscard]] std::vector<Field> potentials(const Vector& unknowns) const {
    return fields(unknowns.cwiseProduct(radius_));
  }

 private:
  StackedEntries entries_;
  Vector radius_;  // R of each entry
};

}  // namespace

template <typename Scalar>
FieldsAtFaces<Scalar> fields_of(const CurrentLaw<Scalar>& law, const Membrane& membrane,
                                const FieldOf<Scalar>& potential) {
  const FieldOf<Scalar> stored = law.a.cwiseProduct(values_of<Scalar>(membrane, potential));
  return {(stored - law.s_in) / law.k_in, (stored + law.s_out) / law.k_out};
}

template <typename Scalar>
SolveReport solve_laws(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                       const std::vector<CurrentLaw<Scalar>>& laws, double tolerance,
                       std::vector<FieldOf<Scalar>>& potentials) {
  // The preconditioner contains only the mean of a: a varying a can take twice as many iterations.
  constexpr int kMostIterations = 120;
  const LawEquations<Scalar> equations(membranes, interaction, laws);
  const StackedPotentials<Scalar> stacked(membranes);
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const Index n = n_coefficients(membranes[a].in_field.membrane.fine.order());
    if (potentials[a].size() != n) potentials[a] = FieldOf<Scalar>::Zero(n);
  }
  const LinearMap map = [&](const Vector& unknowns) {
    return stacked.stack(equations.left_side(stacked.potentials(unknowns)));
  };
  const LinearMap preconditioner = [&](const Vector& residual) {
    return stacked.over_radius(equations.sphere_inverse(stacked.fields(residual)));
  };
  RecycledGcr solver(map, preconditioner, stacked.size());
  const RecycledGcr::Solution solution = solver.solve(stacked.stack(equations.right_side()),
                                                      stacked.over_radius(potentials), {tolerance, kMostIterations});
  potentials = stacked.potentials(solution.x);
  return solution.report;
}

using Complex = std::complex<double>;
template FieldsAtFaces<double> fields_of(const CurrentLaw<double>&, const Membrane&, const FieldOf<double>&);
template FieldsAtFaces<Complex> fields_of(const CurrentLaw<Complex>&, const Membrane&, const FieldOf<Complex>&);
template SolveReport solve_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                const std::vector<CurrentLaw<double>>&, double, std::vector<FieldOf<double>>&);
template SolveReport solve_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                const std::vector<CurrentLaw<Complex>>&, double, std::vector<FieldOf<Complex>>&);

namespace {

/// Contributions of the layers of all other membranes to one; empty without others.
template <typename Scalar>
struct OfOthers {
  FieldOf<Scalar> flux;       // J n·∇ of their double layers minus their single layers, coefficients
  FieldOf<Scalar> potential;  // of their single layers minus their double layers, coefficients
};

template <typename Scalar>
std::vector<OfOthers<Scalar>> layers_of_others(const Interaction& interaction,
                                               const std::vector<FieldOf<Scalar>>& potentials,
                                               const std::vector<FieldOf<Scalar>>& weighted_jumps) {
  std::vector<OfOthers<Scalar>> result(potentials.size());
  if (interaction.is_empty()) return result;
  const auto double_flux = of_others<Scalar>(interaction, &Interaction::weighted_double_flux, potentials);
  const auto single_flux = of_others<Scalar>(interaction, &Interaction::weighted_single_flux, weighted_jumps);
  const auto of_double = of_others<Scalar>(interaction, &Interaction::double_potential, potentials);
  const auto of_single = of_others<Scalar>(interaction, &Interaction::single_potential, weighted_jumps);
  for (const std::size_t a : interaction.partition().local_indices(result.size())) {
    result[a] = {double_flux[a] - single_flux[a], of_single[a] - of_double[a]};
  }
  return result;
}

/// @param weighted_jump  J (E_e − E_i), coefficients; empty if it is zero
template <typename Scalar>
TracesOf<Scalar> traces_of(const ElectricMembrane& of, const CurrentLaw<Scalar>& law, const FieldOf<Scalar>& potential,
                           const FieldOf<Scalar>& weighted_jump, const OfOthers<Scalar>& others) {
  const Membrane& membrane = of.membrane;
  FieldOf<Scalar> weighted_mean = applied_flux<Scalar>(of) + hypersingular<Scalar>(membrane, potential);
  if (weighted_jump.size() > 0) {
    weighted_mean -= values_of<Scalar>(membrane, adjoint<Scalar>(membrane, weighted_jump));
  }
  if (others.flux.size() > 0) weighted_mean += values_of<Scalar>(membrane, others.flux);
  const FieldOf<Scalar> between = mean_potential<Scalar>(of, potential, weighted_jump, others.potential);
  const FieldOf<Scalar> mean = weighted_mean.cwiseQuotient(membrane.surface.area_element.cast<Scalar>());
  TracesOf<Scalar> traces;
  traces.charge = 2.0 * law.contrast() * mean + (2.0 / (law.k_in + law.k_out)) * (law.s_in + law.s_out);
  traces.flux_in = 0.5 * traces.charge - mean;
  traces.flux_out = -0.5 * traces.charge - mean;
  traces.potential_in = between + 0.5 * potential;
  traces.potential_out = between - 0.5 * potential;
  return traces;
}

}  // namespace

template <typename Scalar>
std::vector<TracesOf<Scalar>> traces_of_laws(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction,
                                             const std::vector<CurrentLaw<Scalar>>& laws,
                                             const std::vector<FieldOf<Scalar>>& potentials) {
  const std::vector<std::size_t> own = interaction.partition().local_indices(membranes.size());
  std::vector<FieldOf<Scalar>> jumps(membranes.size());
  for (const std::size_t a : own) {
    if (!carries_charge(membranes[a].in_field.electric)) continue;
    const Membrane& membrane = membranes[a].in_field.membrane;
    const FieldsAtFaces<Scalar> fields = fields_of(laws[a], membrane, potentials[a]);
    jumps[a] = weighted<Scalar>(membrane, fields.out - fields.in);
  }
  const std::vector<OfOthers<Scalar>> others = layers_of_others<Scalar>(interaction, potentials, jumps);
  std::vector<TracesOf<Scalar>> traces(membranes.size());
  for (const std::size_t a : own) {
    traces[a] = traces_of<Scalar>(membranes[a].in_field, laws[a], potentials[a], jumps[a], others[a]);
  }
  return traces;
}

using Complex = std::complex<double>;
template std::vector<TracesOf<double>> traces_of_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                                      const std::vector<CurrentLaw<double>>&,
                                                      const std::vector<FieldOf<double>>&);
template std::vector<TracesOf<Complex>> traces_of_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                                       const std::vector<CurrentLaw<Complex>>&,
                                                       const std::vector<FieldOf<Complex>>&);

}  // namespace vehd
