#include "bie/physics/current_law.hpp"

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
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

MembraneCurrent membrane_current(const ChargingMembrane& of) {
  const auto& [electric, membrane] = of.in_field;
  const Vector& pump = membrane.material.pump_current;
  return {conductance_of(of.charging, membrane),
          pump.size() > 0 ? Vector(electric.pump * pump) : Vector(Vector::Zero(membrane.surface.n_points()))};
}

Vector current_through(const Membrane& membrane, const MembraneCurrent& current, const Vector& potential) {
  return current.conductance.cwiseProduct(Vector(membrane.fine.synthesize(potential))) + current.constant;
}

namespace {

/// The equation of one membrane, weighted by J and divided by the mean of a + κ/R. Coefficients of degree p.
class LawEquation {
 public:
  /// Both must outlive it.
  LawEquation(const ElectricMembrane& of, const CurrentLaw& law)
      : membrane_(of.membrane), field_(of.electric.field), law_(law) {
    share_in_ = law.k_out / (law.k_in + law.k_out);
    share_out_ = law.k_in / (law.k_in + law.k_out);
    kappa_ = law.k_in * share_in_;
    const Vector& area = membrane_.surface.quadrature;
    const double mean = law.a.dot(area) / area.sum();
    size_ = mean + kappa_ / membrane_.radius;
    storage_ = mean / size_;
  }

  [[nodiscard]] double conduction() const { return kappa_ / size_; }
  [[nodiscard]] bool stores() const { return storage_ > 0.0; }

  /// What V does on its own membrane.
  [[nodiscard]] Vector own(const Vector& potential) const {
    Vector result = Vector::Zero(potential.size());
    double mean = potential[0];
    if (stores()) {
      const Vector stored = weighted(of_potential(potential)) / size_;
      result = second_kind_operator(membrane_, contrast(), stored);
      mean = stored[0];
    }
    if (kappa_ > 0.0) {
      result -= conduction() * membrane_.fine.analyze(weighted_hypersingular(membrane_, potential));
    }
    result[0] = mean;
    return result;
  }

  /// Inverse of `own` on the sphere of the same area with the mean of a.
  [[nodiscard]] Vector sphere_inverse(const Vector& residual) const {
    const double radius = membrane_.radius;
    Vector result(residual.size());
    for (int n = 0; n <= membrane_.fine.order(); ++n) {
      const double odd = 2.0 * n + 1.0;
      const double second_kind = n == 0 ? 1.0 : 0.5 - contrast() / (2.0 * odd);
      double eigenvalue = storage_ * radius * radius * second_kind + conduction() * radius * n * (n + 1.0) / odd;
      if (eigenvalue == 0.0) eigenvalue = 1.0;
      for (Index i = coefficient_index(n, -n); i <= coefficient_index(n, n); ++i) result[i] = residual[i] / eigenvalue;
    }
    return result;
  }

  /// Of the field and of what the faces hold.
  [[nodiscard]] Vector right_side() const {
    Vector rhs = conduction() * membrane_.fine.analyze(weighted_field_flux(membrane_, field_));
    const Vector uneven = share_in_ * law_.s_in - share_out_ * law_.s_out;
    if (!uneven.isZero(0.0)) rhs += (0.5 / size_) * weighted(uneven);
    const Vector given = given_jump();
    if (!given.isZero(0.0)) rhs -= membrane_.layers.laplace_adjoint.apply(weighted(given) / size_);
    rhs[0] = stores() ? weighted(law_.s_in)[0] / size_ : 0.0;
    return rhs;
  }

  /// J (E_e − E_i) for s = 0; empty where it is zero.
  [[nodiscard]] Vector weighted_jump_of(const Vector& potential) const {
    if (contrast() == 0.0 || !stores()) return {};
    return weighted((contrast() / kappa_) * of_potential(potential));
  }
  /// J (E_e − E_i) for V = 0; empty where it is zero.
  [[nodiscard]] Vector weighted_jump_given() const {
    const Vector given = given_jump();
    return given.isZero(0.0) ? Vector() : weighted(given / kappa_);
  }

 private:
  /// η.
  [[nodiscard]] double contrast() const { return share_out_ - share_in_; }
  /// κ(E_e − E_i) for V = 0.
  [[nodiscard]] Vector given_jump() const { return share_in_ * law_.s_in + share_out_ * law_.s_out; }
  /// aV.
  [[nodiscard]] Vector of_potential(const Vector& potential) const {
    return law_.a.cwiseProduct(Vector(membrane_.fine.synthesize(potential)));
  }
  [[nodiscard]] Vector weighted(const Vector& values) const { return membrane_.weighted(values); }

  const Membrane& membrane_;
  const Vector3& field_;
  const CurrentLaw& law_;
  double share_in_, share_out_;  // w_i, w_e
  double kappa_, size_, storage_;
};

/// The equations of all membranes.
class LawEquations {
 public:
  LawEquations(const std::vector<ElectricMembrane>& membranes, const Interaction* interaction,
               const std::vector<CurrentLaw>& laws)
      : interaction_(interaction),
        owned_((interaction != nullptr ? interaction->shares() : Shares()).own(laws.size())) {
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      const LawEquation& one = of_each_.emplace_back(membranes[b], laws[b]);
      if (interaction_ != nullptr && one.conduction() == 0.0 && one.stores()) {
        throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
      }
    }
  }

  [[nodiscard]] std::vector<Vector> left_side(const std::vector<Vector>& potentials) const {
    std::vector<Vector> result(potentials.size());
    if (interaction_ != nullptr) {
      const std::vector<Vector> jumps =
          of_owned([&](std::size_t b) { return of_each_[b].weighted_jump_of(potentials[b]); });
      result = interaction_->weighted_single_flux(jumps);
      const std::vector<Vector> of_potentials = interaction_->weighted_double_flux(potentials);
      for (const std::size_t a : owned_) result[a] = of_each_[a].conduction() * (result[a] - of_potentials[a]);
    }
    for_each_member(owned_, [&](std::size_t a) { add(of_each_[a].own(potentials[a]), result[a]); });
    return gathered(std::move(result));
  }

  [[nodiscard]] std::vector<Vector> right_side() const {
    std::vector<Vector> result = of_owned([&](std::size_t a) { return of_each_[a].right_side(); });
    if (interaction_ != nullptr) {
      const std::vector<Vector> of_others = interaction_->weighted_single_flux(
          of_owned([&](std::size_t b) { return of_each_[b].weighted_jump_given(); }));
      for (const std::size_t a : owned_) result[a] -= of_each_[a].conduction() * of_others[a];
    }
    return gathered(std::move(result));
  }

  [[nodiscard]] std::vector<Vector> sphere_inverse(std::vector<Vector> residuals) const {
    for (std::size_t a = 0; a < residuals.size(); ++a) residuals[a] = of_each_[a].sphere_inverse(residuals[a]);
    return residuals;
  }

 private:
  static void add(Vector of_own, Vector& sum) {
    if (sum.size() > 0) of_own += sum;
    sum = std::move(of_own);
  }

  template <typename Make>
  [[nodiscard]] std::vector<Vector> of_owned(const Make& make) const {
    std::vector<Vector> result(of_each_.size());
    for (const std::size_t a : owned_) result[a] = make(a);
    return result;
  }

  [[nodiscard]] std::vector<Vector> gathered(std::vector<Vector> fields) const {
    if (interaction_ != nullptr) interaction_->gather_potentials(fields);
    return fields;
  }

  const Interaction* interaction_;
  std::vector<std::size_t> owned_;  // membranes of this rank
  std::vector<LawEquation> of_each_;
};

/// V/R of all membranes, one behind the other.
struct StackedPotentials {
  StackedEntries entries;
  Vector radius;  // of each entry

  explicit StackedPotentials(const std::vector<ElectricMembrane>& membranes) : entries(entries_of(membranes)) {
    std::vector<double> radii;
    for (const ElectricMembrane& one : membranes) radii.push_back(one.membrane.radius);
    radius = entries.spread(radii);
  }

  static StackedEntries entries_of(const std::vector<ElectricMembrane>& membranes) {
    std::vector<Index> sizes;
    std::vector<std::vector<Index>> entries;
    for (const ElectricMembrane& one : membranes) {
      sizes.push_back(n_coefficients(one.membrane.fine.order()));
      entries.push_back(one.membrane.subspace.potentials());
    }
    return {std::move(sizes), std::move(entries)};
  }

  [[nodiscard]] Vector over_radius(const std::vector<Vector>& potentials) const {
    return entries.stack(potentials).cwiseQuotient(radius);
  }
  [[nodiscard]] std::vector<Vector> potentials(const Vector& unknowns) const {
    return entries.parts(unknowns.cwiseProduct(radius));
  }
};

}  // namespace

SolveReport solve_laws(const std::vector<ElectricMembrane>& membranes, const Interaction* interaction,
                       const std::vector<CurrentLaw>& laws, double tolerance, std::vector<Vector>& potentials) {
  // The inverse on a sphere knows the mean of a alone, which may take twice as many iterations.
  constexpr int kMostIterations = 120;
  const LawEquations equations(membranes, interaction, laws);
  const StackedPotentials stacked(membranes);
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const Index n = n_coefficients(membranes[a].membrane.fine.order());
    if (potentials[a].size() != n) potentials[a] = Vector::Zero(n);
  }
  const LinearMap map = [&](const Vector& unknowns) {
    return stacked.entries.stack(equations.left_side(stacked.potentials(unknowns)));
  };
  const LinearMap preconditioner = [&](const Vector& residual) {
    return stacked.over_radius(equations.sphere_inverse(stacked.entries.parts(residual)));
  };
  RecycledGcr solver(map, preconditioner, stacked.entries.size());
  const RecycledGcr::Solution solution = solver.solve(stacked.entries.stack(equations.right_side()),
                                                      stacked.over_radius(potentials), {tolerance, kMostIterations});
  potentials = stacked.potentials(solution.x);
  return solution.report;
}

}  // namespace vehd
