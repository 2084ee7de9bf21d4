#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "bie/physics/effects/poration.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd::testing {

/// Charges of both faces and the state of poration over a sphere of radius 1 with displacement currents, in harmonics
/// of the potentials on both sides, φ_i = A_n r^n and φ_e = B_n r^−(n+1) − E z: only the transform and the pointwise
/// functions are shared with the solver.
class RelaxingSphere {
 public:
  /// Coefficients of q_i and q_i + q_e, both over the C_m of the parameters, and of s.
  struct Charges {
    Vector inner, sum, reaction;
  };

  /// @param electric  with a field along z
  /// @param reaction  null: none
  RelaxingSphere(int order, const ElectricParameters& electric, double capacitance, MembraneMaterial material,
                 const PorationReaction* reaction)
      : transform_(order, make_grid(2 * order)),
        electric_(electric),
        capacitance_(capacitance),
        material_(std::move(material)),
        reaction_(reaction),
        degree_(n_coefficients(order)) {
    for (int n = 0; n <= order; ++n) degree_.segment(coefficient_index(n, -n), 2 * n + 1).setConstant(n);
    const Index size = degree_.size();
    Matrix map(size, size);
    for (Index j = 0; j < size; ++j) map.col(j) = of_inner(Vector::Unit(size, j));
    solver_ = map.partialPivLu();
  }

  [[nodiscard]] Vector potential(const Charges& y, double time) const { return solved(y, time).potential; }

  [[nodiscard]] Charges rate(const Charges& y, double time) const {
    const Fields fields = solved(y, time);
    const Vector v = on_grid(fields.potential);
    Vector conductance = on_grid(material_.conductance);
    const Vector s = reaction_ == nullptr ? Vector(Vector::Zero(v.size())) : on_grid(y.reaction);
    if (reaction_ != nullptr) {
      for (Index i = 0; i < s.size(); ++i) conductance[i] += reaction_->conductance(s[i]).value;
    }
    Vector current = conductance.cwiseProduct(v);
    if (material_.pump_current.size() > 0) {
      current += electric_.pump * electric_.pump_waveform.at(time) * on_grid(material_.pump_current);
    }
    const Vector in = electric_.conductivity_in * fields.inside, out = electric_.conductivity_out * fields.outside;
    Charges result{(in - Vector(transform_.analyze(current))) / capacitance_, (in - out) / capacitance_, {}};
    if (reaction_ != nullptr) {
      result.reaction =
          transform_.analyze(Vector(s.binaryExpr(v, [&](double a, double b) { return reaction_->rate(a, b); })));
    }
    return result;
  }

  /// Classical Runge–Kutta rule of order four.
  [[nodiscard]] Charges after(Charges y, double end, int n_steps) const {
    const double dt = end / n_steps;
    const auto moved = [](const Charges& from, double by, const Charges& rate) {
      return Charges{from.inner + by * rate.inner, from.sum + by * rate.sum, from.reaction + by * rate.reaction};
    };
    for (int i = 0; i < n_steps; ++i) {
      const double t = i * dt;
      const Charges a = rate(y, t), b = rate(moved(y, 0.5 * dt, a), t + 0.5 * dt),
                    c = rate(moved(y, 0.5 * dt, b), t + 0.5 * dt), d = rate(moved(y, dt, c), t + dt);
      y = moved(moved(moved(moved(y, dt / 6.0, a), dt / 3.0, b), dt / 3.0, c), dt / 6.0, d);
    }
    return y;
  }

 private:
  struct Fields {
    Vector potential, inside, outside;  ///< V, E_i, E_e
  };

  [[nodiscard]] Vector on_grid(const Vector& coefficients) const {
    return transform_.synthesize(resize_order(coefficients, transform_.order()));
  }
  [[nodiscard]] Vector stored(const Vector& potential) const {
    return transform_.analyze(Vector(on_grid(material_.capacitance).cwiseProduct(on_grid(potential))));
  }
  [[nodiscard]] double in() const { return electric_.permittivity * electric_.permittivity_ratio; }
  [[nodiscard]] double out() const { return electric_.permittivity; }

  /// Contribution of A to q_i without a field or Q: E_i = −n A, ε_e E_e = ε_i E_i.
  [[nodiscard]] Vector of_inner(const Vector& a) const {
    const Vector displaced = in() * degree_.cwiseProduct(a);
    const Vector b = -displaced.cwiseQuotient((degree_.array() + 1.0).matrix()) / out();
    return stored(a - b) + displaced;
  }

  [[nodiscard]] Fields solved(const Charges& y, double time) const {
    Vector applied = Vector::Zero(degree_.size());
    applied[coefficient_index(1, 0)] =
        electric_.field.z() * electric_.waveform.at(time) * std::sqrt(4.0 * std::numbers::pi / 3.0);
    const Vector after = (degree_.array() + 1.0).matrix();
    const Vector sum = capacitance_ * y.sum;
    const Vector b_of_rest = Vector(sum / out() - applied).cwiseQuotient(after);
    const Vector a = solver_.solve(Vector(capacitance_ * y.inner - stored(applied - b_of_rest)));
    const Vector b = b_of_rest - Vector(in() * degree_.cwiseProduct(a)).cwiseQuotient(after) / out();
    return {a - b + applied, -degree_.cwiseProduct(a), after.cwiseProduct(b) + applied};
  }

  SphereTransform transform_;
  ElectricParameters electric_;
  double capacitance_;
  MembraneMaterial material_;
  const PorationReaction* reaction_;
  Vector degree_;  // n of each coefficient
  Eigen::PartialPivLU<Matrix> solver_;
};

}  // namespace vehd::testing
