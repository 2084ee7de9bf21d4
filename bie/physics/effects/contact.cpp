#include "bie/physics/effects/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/physics/model.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

constexpr const char* kContact = "contact";

/// Cut-off distance in ranges, beyond which the potential is below rounding.
constexpr double kReach = 6.0;
/// Spacing of nodes in ranges: the relative error of the trapezoidal rule for a Gaussian is 2 exp(−(π/0.65)²) = 1e-10.
constexpr double kSpacing = 0.65;
constexpr int kHighestOrder = 256;

/// Ball that contains the nodes of a membrane.
struct Ball {
  Vector3 centre;
  double radius;

  [[nodiscard]] bool is_near(const Vector3& x, double reach) const {
    return (x - centre).squaredNorm() <= (radius + reach) * (radius + reach);
  }
};

Ball ball_about(const ContactMembrane& of) {
  const Vector3 centre = mean_vector(of.position);
  const Matrix from_centre = of.membrane.surface.position.rowwise() - centre.transpose();
  return {centre, from_centre.rowwise().norm().maxCoeff()};
}

bool are_near(const Ball& a, const Ball& b, double reach) {
  return (a.centre - b.centre).norm() <= a.radius + b.radius + reach;
}

/// Nodes of a membrane at the spacing that the potential requires, with their quadrature weights.
struct SourceNodes {
  Eigen::Matrix3Xd points;
  Vector areas;
};

SourceNodes source_nodes(const ContactParameters& contact, const ContactMembrane& of) {
  const Surface& s = of.membrane.surface;
  const double stretch = std::sqrt(
      std::max(s.tangent_1.rowwise().squaredNorm().maxCoeff(), s.tangent_2.rowwise().squaredNorm().maxCoeff()));
  const int order = order_of(of.position.rows());
  const double needed = std::ceil(std::numbers::pi * stretch / (kSpacing * contact.range));
  if (!(needed <= kHighestOrder)) {
    throw ConvergenceError(fmt::format("the range of the contact potential is {:.2g} radii; accepted: at least {:.2g}",
                                       contact.range / of.membrane.radius,
                                       std::numbers::pi * stretch / (kSpacing * kHighestOrder * of.membrane.radius)));
  }
  const SphereTransform transform(order, make_grid(std::max(order, static_cast<int>(needed))));
  const Surface fine = make_surface(transform, of.position);
  return {fine.position.transpose(), fine.quadrature};
}

/// W and ∂W/∂n at the points of a surface.
struct PotentialOfOthers {
  Vector value, slope;
};

/// Adds the potential of one membrane at the points of another.
void add_potential(const ContactParameters& contact, const SourceNodes& nodes, const Ball& of_nodes,
                   const Ball& of_targets, const Surface& s, PotentialOfOthers& w) {
  const double reach = kReach * contact.range;
  std::vector<Index> near;
  for (Index j = 0; j < nodes.points.cols(); ++j) {
    if (of_targets.is_near(nodes.points.col(j), reach)) near.push_back(j);
  }
  const double decay = 1.0 / (contact.range * contact.range);
  const double scale = contact.energy * decay / std::numbers::pi;
#pragma omp parallel for schedule(dynamic, 16)
  for (Index i = 0; i < s.n_points(); ++i) {
    const Vector3 x = s.position.row(i).transpose();
    if (!of_nodes.is_near(x, reach)) continue;
    double value = 0.0;
    Vector3 gradient = Vector3::Zero();
    for (const Index j : near) {
      const Vector3 r = x - nodes.points.col(j);
      const double squared = r.squaredNorm();
      if (squared > reach * reach) continue;
      const double term = nodes.areas[j] * std::exp(-squared * decay);
      value += term;
      gradient -= 2.0 * decay * term * r;
    }
    w.value[i] += scale * value;
    w.slope[i] += scale * gradient.dot(s.normal.row(i));
  }
}

std::vector<PotentialOfOthers> potentials_of_others(const ContactParameters& contact,
                                                    const std::vector<ContactMembrane>& membranes) {
  const double reach = kReach * contact.range;
  std::vector<Ball> balls;
  std::vector<PotentialOfOthers> result;
  for (const ContactMembrane& of : membranes) {
    balls.push_back(ball_about(of));
    const Index n = of.membrane.surface.n_points();
    result.push_back({Vector::Zero(n), Vector::Zero(n)});
  }
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    std::vector<std::size_t> neighbours;
    for (std::size_t a = 0; a < membranes.size(); ++a) {
      if (a != b && are_near(balls[a], balls[b], reach)) neighbours.push_back(a);
    }
    if (neighbours.empty()) continue;
    const SourceNodes nodes = source_nodes(contact, membranes[b]);
    for (const std::size_t a : neighbours) {
      add_potential(contact, nodes, balls[b], balls[a], membranes[a].membrane.surface, result[a]);
    }
  }
  return result;
}

}  // namespace

std::vector<Matrix> contact_forces(const ContactParameters& contact, const std::vector<ContactMembrane>& membranes) {
  std::vector<Matrix> forces;
  for (const PotentialOfOthers& w : potentials_of_others(contact, membranes)) {
    const Surface& s = membranes[forces.size()].membrane.surface;
    const Vector magnitude = 2.0 * s.mean_curvature.cwiseProduct(w.value) - w.slope;
    forces.emplace_back(magnitude.asDiagonal() * s.normal);
  }
  return forces;
}

double contact_energy(const ContactParameters& contact, const std::vector<ContactMembrane>& membranes) {
  const std::vector<PotentialOfOthers> potentials = potentials_of_others(contact, membranes);
  double sum = 0.0;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    sum += potentials[a].value.dot(membranes[a].membrane.surface.quadrature);
  }
  return 0.5 * sum;
}

EffectRow contact_row() {
  return {kContact,
          [](const Model& model, const VesicleModel&) -> MadeEffect {
            if (!model.mobile || !model.contact) return nullptr;
            return described([] {
              return EffectDescription{
                  kContact,
                  "f_c = -dE/dx of E = sum of energy/(pi range^2) exp(-r^2/range^2) over both membranes",
                  {{&LayerSelection::stokes_single, "velocity of f_c, Eq. (5)"}},
                  {}};
            });
          },
          [](Model& model, VesicleModel&) { model.contact.reset(); }};
}

}  // namespace vehd
