#include "bie/comparison/check_problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bie/geometry/surface.hpp"
#include "bie/physics/electric.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

constexpr int directions = 12;
constexpr std::array offsets_in_spacings{-1.0, -0.5, -0.1, 0.1, 0.5, 1.0};
constexpr std::array shares_towards_centre{0.25, 0.6};
constexpr std::array offsets_in_radii{0.7, 1.5, 3.0};

/// Evenly spread nodes of the grid, no two of them on one meridian.
Index spread(int i, Index n) { return static_cast<Index>((i + 0.5) * static_cast<double>(n) / directions); }

}  // namespace

CheckSamples check_samples(const Matrix& position, const std::optional<Wall>& wall) {
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(order));
  const Surface surface = make_surface(transform, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  const Vector3 centre = centroid(surface);
  CheckSamples samples;
  samples.near = std::numbers::pi * radius / order;
  std::vector<Vector3> points;
  std::vector<double> distances;
  const auto add = [&](const Vector3& point, double distance) {
    if (wall && !(wall->height(point) > 0.0)) return;
    points.push_back(point);
    distances.push_back(distance);
  };
  for (int i = 0; i < directions; ++i) {
    const Index node = spread(i, surface.n_points());
    const Vector3 x = surface.position.row(node).transpose();
    const Vector3 n = surface.normal.row(node).transpose();
    const double first = offsets_in_spacings[i % offsets_in_spacings.size()] * samples.near;
    add(x + first * n, std::abs(first));
    add(x - first * n, std::abs(first));
    add(centre + shares_towards_centre[i % shares_towards_centre.size()] * (x - centre), 0.0);
    add(x + offsets_in_radii[i % offsets_in_radii.size()] * radius * n, 0.0);
  }
  samples.points.resize(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) samples.points.row(static_cast<Index>(i)) = points[i].transpose();
  samples.distance = Eigen::Map<Vector>(distances.data(), static_cast<Index>(distances.size()));
  return samples;
}

Matrix where_possible(const Matrix& points, Index components, std::vector<bool>& is_inside,
                      const std::function<SampleValues(const Matrix&)>& at) {
  Matrix result = Matrix::Constant(points.rows(), components, std::numeric_limits<double>::quiet_NaN());
  is_inside.assign(static_cast<std::size_t>(points.rows()), false);
  const auto take = [&](Index first, Index n) {
    const auto [values, sides] = at(Matrix(points.middleRows(first, n)));
    result.middleRows(first, n) = values;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      is_inside[static_cast<std::size_t>(first) + i] = sides[i] == Side::interior;
    }
  };
  try {
    take(0, points.rows());
  } catch (const ConvergenceError&) {
    for (Index i = 0; i < points.rows(); ++i) {
      try {
        take(i, 1);
      } catch (const ConvergenceError&) {
        // It stays NaN: another part of the membrane is as near, or the degree is too low for the shape.
      }
    }
  }
  return result;
}

Model compared_model(const FrozenState& frozen, const CheckContents& contents) {
  Model model = frozen.model;
  if (!contents.electric) model.electric.reset();
  model.mobile = contents.flow;
  return model;
}

NumericalSettings settings_at(const FrozenState& frozen, int order, std::size_t vesicle) {
  NumericalSettings settings = frozen.settings;
  if (order != order_of(frozen.state.vesicles[vesicle].position.rows())) {
    const NumericalSettings defaults;
    settings.flow_tolerance = std::min(settings.flow_tolerance, defaults.flow_tolerance);
    settings.electric_tolerance = std::min(settings.electric_tolerance, defaults.electric_tolerance);
  }
  settings.order = order;
  return settings;
}

namespace {

/// Refuses effects that the finite-element side supports for one vesicle only.
void require_plain_charging(const FrozenState& frozen) {
  const auto refuse = [&](const char* what) {
    throw InputError(
        fmt::format("{}: has {}, which the finite-element check supports for one vesicle only; accepted: "
                    "two without",
                    frozen.source, what));
  };
  if (relaxes_charge(frozen.model)) refuse("displacement currents");
  for (const VesicleModel& vesicle : frozen.model.vesicles) {
    if (vesicle.reaction || vesicle.has_varying_properties || vesicle.pump) {
      refuse("a membrane that porates or varies in space");
    }
  }
}

/// @throws InputError if the finite-element side does not support an effect of the scene, or for one vesicle only
CheckContents check_contents(const FrozenState& frozen) {
  const Model& model = frozen.model;
  CheckContents contents;
  contents.flow = model.mobile;
  for (const VesicleModel& vesicle : model.vesicles) {
    if (contents.flow && !(vesicle.viscosity_ratio > 0.0)) {
      throw InputError(fmt::format("{}: the viscosity inside is {:g}; the finite-element check needs it above zero",
                                   frozen.source, vesicle.viscosity_ratio * model.viscosity));
    }
  }
  if (model.electric) {
    std::vector<double> conductivities;
    for (const VesicleModel& vesicle : model.vesicles) conductivities.push_back(vesicle.inside.conductivity);
    conductivities.push_back(model.electric->conductivity);
    for (const double sigma : conductivities) {
      if (sigma > 0.0) continue;
      throw InputError(fmt::format("{}: a conductivity is {:g}; the finite-element check needs both above zero",
                                   frozen.source, sigma));
    }
    contents.steady = !electric_at(frozen).field.isZero(0.0);
    contents.electric = contents.steady || electric_at(frozen).pump != 0.0;
    for (std::size_t a = 0; a < model.vesicles.size(); ++a) {
      const VesicleState& membrane = frozen.state.vesicles[a];
      const VesicleModel& vesicle = model.vesicles[a];
      const bool charged = !membrane.transmembrane_potential.isZero(0.0) || !membrane.free_charge.isZero(0.0);
      contents.electric = contents.electric || charged;
      if (vesicle.reaction || membrane.material.conductance.size() > 0 || vesicle.pump) contents.steady = false;
    }
    if (model.vesicles.size() > 1) require_plain_charging(frozen);
  }
  if (!contents.electric && !contents.flow) {
    throw InputError(fmt::format("{}: neither a field nor a flow at time {}: there is nothing to compare",
                                 frozen.source, frozen.time_text));
  }
  return contents;
}

}  // namespace

ElectricParameters electric_at(const FrozenState& frozen, std::size_t vesicle) {
  if (!frozen.model.electric) return {};
  return electric_parameters(frozen.model, frozen.model.vesicles[vesicle]).at(frozen.state.time, Limit::after);
}

Matrix3 flow_gradient(const FrozenState& frozen) {
  if (!frozen.model.flow) return Matrix3::Zero();
  return frozen.model.flow->waveform.at(frozen.state.time, Limit::after) * frozen.model.flow->gradient;
}

Matrix total_force(const FrozenState& frozen, const VesicleFields& fields, std::size_t vesicle) {
  const Matrix& position = frozen.state.vesicles[vesicle].position;
  Matrix force = Matrix::Zero(position.rows(), 3);
  if (fields.force_bending.size() > 0) force += fields.force_bending;
  if (fields.force_tension.size() > 0) force += fields.force_tension;
  if (fields.force_electric.size() > 0) force -= fields.force_electric;
  if (fields.force_contact.size() > 0) force += fields.force_contact;
  Model others = frozen.model;
  others.flow.reset();
  const auto effects = explicit_effects(others, others.vesicles[vesicle]);
  if (effects.empty()) return force;

  // The run file stores no other forces; they are computed from the shape and the time.
  Instruments instruments;
  const MembraneSpace space(settings_at(frozen, order_of(position.rows()), vesicle), frozen.symmetry);
  const Membrane membrane = membrane_at(space, position, {}, 1.0, instruments);
  for (const auto& effect : effects) {
    Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), Matrix::Zero(position.rows(), 3)};
    effect->add({membrane, position, frozen.state.time}, forcing);
    if (!forcing.velocity.isZero(0.0)) {
      throw InputError(fmt::format("{}: the finite-element check supports linear background flows only, not: {}",
                                   frozen.source, effect->description().name));
    }
    force += membrane.fine.analyze(forcing.force);
  }
  return force;
}

CheckProblem check_problem(const FrozenState& frozen) {
  CheckProblem problem{frozen, check_contents(frozen), {}, {}};
  const std::size_t n = frozen.state.vesicles.size();
  problem.forces.resize(n);
  for (std::size_t a = 0; problem.contents.flow && a < n; ++a) {
    problem.forces[a] = total_force(frozen, frozen.fields.vesicles[a], a);
  }
  if (n == 1) problem.samples = check_samples(frozen.state.vesicles.front().position, frozen.model.wall);
  return problem;
}

}  // namespace vehd
