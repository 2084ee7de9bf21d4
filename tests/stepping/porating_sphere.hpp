#pragma once

#include <cmath>
#include <numbers>

#include "bie/physics/effects/poration.hpp"
#include "bie/sphere/grid.hpp"
#include "bie/support/types.hpp"

namespace vehd::testing {

/// Classical Runge–Kutta rule of order four for y' = rate(y).
template <typename Rate>
Vector runge_kutta_step(const Vector& y, double dt, const Rate& rate) {
  const Vector a = rate(y), b = rate(y + 0.5 * dt * a), c = rate(y + 0.5 * dt * b), d = rate(y + dt * c);
  return y + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
}

/// V_m and s over a sphere of radius 1 in a field along its axis, by Legendre series of the potentials on both sides
/// and an explicit rule in time: only the pointwise functions are shared with the solver.
class PoratingSphere {
 public:
  struct Parameters {
    double field, conductivity_in, conductivity_out, capacitance, conductance;
  };

  PoratingSphere(const Parameters& parameters, const PorationReaction& reaction, int n_nodes)
      : p_(parameters), reaction_(reaction), legendre_(n_nodes, n_nodes) {
    const SphereGrid grid = make_grid(n_nodes - 1);
    for (int j = 0; j < n_nodes; ++j) {
      const double x = std::cos(grid.theta[j]);
      for (int l = 0; l < n_nodes; ++l) legendre_(j, l) = std::legendre(static_cast<unsigned>(l), x);
    }
    weights_ = grid.weight * (grid.n_phi / (2.0 * std::numbers::pi));
    y_ = Vector(2 * n_nodes);
    y_.head(n_nodes).setZero();
    y_.tail(n_nodes).setConstant(reaction.start());
  }

  void advance(double time, int n_steps) {
    for (int i = 0; i < n_steps; ++i) {
      y_ = runge_kutta_step(y_, time / n_steps, [&](const Vector& y) { return rate(y); });
    }
  }

  [[nodiscard]] double potential_at_pole() const { return at_pole(y_.head(y_.size() / 2)); }
  [[nodiscard]] double state_at_pole() const { return at_pole(y_.tail(y_.size() / 2)); }

 private:
  [[nodiscard]] Vector series(const Vector& values) const {
    Vector result = legendre_.transpose() * weights_.cwiseProduct(values);
    for (Index l = 0; l < result.size(); ++l) result[l] *= (2.0 * static_cast<double>(l) + 1.0) / 2.0;
    return result;
  }

  [[nodiscard]] double at_pole(const Vector& values) const { return series(values).sum(); }

  [[nodiscard]] Vector rate(const Vector& y) const {
    const Index n = y.size() / 2;
    const Vector potential = y.head(n);
    // φ_i = A_l r^l, φ_e = B_l r^−(l+1) − E r cos θ; V_l = A_l − B_l + E δ_l1, with equal currents on both sides.
    Vector current = series(potential);
    for (Index l = 0; l < n; ++l) {
      const double order = static_cast<double>(l);
      const double driven = l == 1 ? 3.0 * p_.field : 0.0;
      const double inside = p_.conductivity_out * ((order + 1.0) * current[l] - driven) /
                            (p_.conductivity_in * order + p_.conductivity_out * (order + 1.0));
      current[l] = -p_.conductivity_in * order * inside;
    }
    Vector result(2 * n);
    result.head(n) = legendre_ * current;
    for (Index j = 0; j < n; ++j) {
      const double leak = (p_.conductance + reaction_.conductance(y[n + j]).value) * potential[j];
      result[j] = (result[j] - leak) / p_.capacitance;
      result[n + j] = reaction_.rate(y[n + j], potential[j]);
    }
    return result;
  }

  Parameters p_;
  const PorationReaction& reaction_;
  Matrix legendre_;
  Vector weights_, y_;
};

}  // namespace vehd::testing
