#include "tests/invariance/columns.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vehd::testing {
namespace {

/// The long axis is defined if the two largest moments of the shape differ, and its inclination if the axis is not
/// normal to the plane.
bool has_inclination(const State& state) {
  const Matrix shape = state.vesicles.back().position.bottomRows(state.vesicles.back().position.rows() - 1);
  const Eigen::SelfAdjointEigenSolver<Matrix3> moments(Matrix3(shape.transpose() * shape));
  const Vector3& values = moments.eigenvalues();
  return values[2] - values[1] > 1e-2 * values[2] && std::abs(moments.eigenvectors()(1, 2)) < 0.99;
}

/// Scale of the differences of a column, also if its values are only rounding: the largest V_m over the size for a
/// charge whose conductivities nearly cancel, the bending modulus for a tension that is free.
double natural_scale(const Column& column, const ShortRun& run) {
  double scale = column.least_scale;
  for (const RunRow& row : run.rows) {
    const double size = std::abs(column.value(row.diagnostics));
    // Infinite until the poration criterion is met.
    if (std::isfinite(size)) scale = std::max(scale, size);
    if (column.scale != nullptr) scale = std::max(scale, column.scale(row.diagnostics));
    if (column.member == &VesicleDiagnostics::q_north)
      scale = std::max(scale, row.diagnostics.Vm_max / row.diagnostics.extent_x);
  }
  if (column.member == &VesicleDiagnostics::tension_integral) scale = std::max(scale, run.bending_modulus);
  const RunRow& last = run.rows.back();
  const double size = last.diagnostics.extent_x;
  if (column.member == &VesicleDiagnostics::tension_max) scale = std::max(scale, run.bending_modulus / (size * size));
  // A vesicle at rest stays in place up to rounding, relative to its size and to the time of the run.
  if (column.depends == Column::Depends::on_place) {
    const bool is_velocity = column.powers[1] != 0;
    scale = std::max(scale, is_velocity ? size / std::max(last.state.time, std::numeric_limits<double>::min()) : size);
  }
  if (column.member == &VesicleDiagnostics::Vm_pole_plus || column.member == &VesicleDiagnostics::Vm_pole_minus) {
    scale = std::max(scale, last.diagnostics.Vm_max);
  }
  return scale;
}

double difference(const Column& column, const RunRow& a, const RunRow& b, double factor) {
  const double here = column.value(a.diagnostics), there = column.value(b.diagnostics);
  if (!std::isfinite(here) && !std::isfinite(there)) return 0.0;
  const double size = std::abs(here - there / factor);
  if (column.member != &VesicleDiagnostics::inclination_deg) return size;
  // An axis is unchanged by half a turn.
  return has_inclination(a.state) ? std::min(size, std::abs(180.0 - size)) : 0.0;
}

template <int i, int j>
double stress(const VesicleDiagnostics& d) {
  const Matrix3 moment = d.rheology.moment();
  return 0.5 * (moment(i, j) + moment(j, i));
}

/// Largest contribution: contributions that nearly cancel are only as accurate as each of them.
double largest_share(const VesicleDiagnostics& d) {
  const Rheology& r = d.rheology;
  return std::max({r.bending.norm(), r.tension.norm(), r.electric.norm(), r.others.norm(), r.viscosity.norm()});
}

/// The corresponding scale of a net force.
double share_of_force(const VesicleDiagnostics& d) { return largest_share(d) / std::sqrt(d.area); }

bool same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(a); }

}  // namespace

const std::vector<Column>& columns() {
  using enum Column::Depends;
  static const std::vector<Column> all = {
      {"area", &VesicleDiagnostics::area, {2, 0, 0, 0}},
      {"volume", &VesicleDiagnostics::volume, {3, 0, 0, 0}},
      {"reduced_volume", &VesicleDiagnostics::reduced_volume},
      {"bending_energy_scaled", &VesicleDiagnostics::bending_energy_scaled},
      {"tension_integral", &VesicleDiagnostics::tension_integral, {3, -1, 1, 0}},
      {"Vm_north", &VesicleDiagnostics::Vm_north, {0, 0, 0, 1}, on_axes},
      {"q_north", &VesicleDiagnostics::q_north, {-1, 0, 0, 1}, on_axes},
      {"Vm_max", &VesicleDiagnostics::Vm_max, {0, 0, 0, 1}},
      {"extent_x", &VesicleDiagnostics::extent_x, {1, 0, 0, 0}, on_axes},
      {"extent_y", &VesicleDiagnostics::extent_y, {1, 0, 0, 0}, on_axes},
      {"extent_z", &VesicleDiagnostics::extent_z, {1, 0, 0, 0}, on_axes},
      {"inclination_deg", &VesicleDiagnostics::inclination_deg, {}, on_axes, 90.0},
      {"area_drift", &VesicleDiagnostics::area_drift, {}, on_nothing, 1.0},
      {"volume_drift", &VesicleDiagnostics::volume_drift, {}, on_nothing, 1.0},
      // The step itself holds the strain only to 1e-6, more loosely than any other quantity.
      {"strain_max", &VesicleDiagnostics::strain_max, {}, on_nothing, 10.0},
      {"spectrum_tail", &VesicleDiagnostics::spectrum_tail, {}, on_nothing, 1.0},
      {"centroid_x", &VesicleDiagnostics::centroid_x, {1, 0, 0, 0}, on_place},
      {"centroid_y", &VesicleDiagnostics::centroid_y, {1, 0, 0, 0}, on_place},
      {"centroid_z", &VesicleDiagnostics::centroid_z, {1, 0, 0, 0}, on_place},
      {"centroid_velocity_x", &VesicleDiagnostics::centroid_velocity_x, {1, -1, 0, 0}, on_place},
      {"centroid_velocity_y", &VesicleDiagnostics::centroid_velocity_y, {1, -1, 0, 0}, on_place},
      {"centroid_velocity_z", &VesicleDiagnostics::centroid_velocity_z, {1, -1, 0, 0}, on_place},
      {"tension_max", &VesicleDiagnostics::tension_max, {1, -1, 1, 0}},
      {"elastic_energy_scaled", &VesicleDiagnostics::elastic_energy_scaled},
      {"aspect_ratio", &VesicleDiagnostics::aspect_ratio},
      {"aspect_ratio_field", &VesicleDiagnostics::aspect_ratio_field},
      {"shape_mode_2",
       nullptr,
       {},
       on_nothing,
       1.0,
       [](const VesicleDiagnostics& d) { return d.shape_modes[0]; },
       nullptr},
      {"shape_mode_3",
       nullptr,
       {},
       on_nothing,
       1.0,
       [](const VesicleDiagnostics& d) { return d.shape_modes[1]; },
       nullptr},
      {"tumbling_frequency", &VesicleDiagnostics::tumbling_frequency, {0, -1, 0, 0}},
      {"treading_frequency", &VesicleDiagnostics::treading_frequency, {0, -1, 0, 0}},
      {"Vm_pole_plus", &VesicleDiagnostics::Vm_pole_plus, {0, 0, 0, 1}},
      {"Vm_pole_minus", &VesicleDiagnostics::Vm_pole_minus, {0, 0, 0, 1}},
      {"Vm_phase_deg", &VesicleDiagnostics::Vm_phase_deg, {}, on_nothing, 90.0},
      {"stress_xx", nullptr, {3, -1, 1, 0}, on_axes, 0.0, stress<0, 0>, largest_share},
      {"stress_xy", nullptr, {3, -1, 1, 0}, on_axes, 0.0, stress<0, 1>, largest_share},
      {"stress_xz", nullptr, {3, -1, 1, 0}, on_axes, 0.0, stress<0, 2>, largest_share},
      {"stress_yz", nullptr, {3, -1, 1, 0}, on_axes, 0.0, stress<1, 2>, largest_share},
      {"effective_viscosity_intrinsic",
       nullptr,
       {},
       on_nothing,
       0.0,
       [](const VesicleDiagnostics& d) { return d.rheology.intrinsic_viscosity(); },
       [](const VesicleDiagnostics& d) {
         const double strain = (d.rheology.gradient + d.rheology.gradient.transpose()).norm();
         return strain > 0.0 ? largest_share(d) / (d.rheology.fluid_viscosity * strain * d.rheology.volume) : 0.0;
       }},
      {"dipole_x",
       nullptr,
       {4, -1, 1, -1},
       on_axes,
       0.0,
       [](const VesicleDiagnostics& d) { return d.rheology.dipole.x(); },
       [](const VesicleDiagnostics& d) { return d.rheology.dipole.norm(); }},
      {"dipole",
       nullptr,
       {4, -1, 1, -1},
       on_nothing,
       0.0,
       [](const VesicleDiagnostics& d) { return d.rheology.dipole.norm(); },
       nullptr},
      {"power",
       nullptr,
       {3, -2, 1, 0},
       on_nothing,
       0.0,
       [](const VesicleDiagnostics& d) { return d.rheology.power(); },
       [](const VesicleDiagnostics& d) { return largest_share(d) * d.rheology.gradient.norm(); }},
      {"conductance_max", &VesicleDiagnostics::conductance_max, {1, -2, 1, -2}},
      {"poration_load", &VesicleDiagnostics::poration_load},
      {"elastic_energy", &VesicleDiagnostics::elastic_energy, {3, -1, 1, 0}},
      {"gap_wall", &VesicleDiagnostics::gap_wall, {1, 0, 0, 0}},
      {"force_wall", &VesicleDiagnostics::force_wall, {2, -1, 1, 0}, on_nothing, 0.0, nullptr, share_of_force},
      {"poration_time", &VesicleDiagnostics::poration_time, {0, 1, 0, 0}},
      {"poration_x", &VesicleDiagnostics::poration_x, {1, 0, 0, 0}, on_place},
      {"poration_y", &VesicleDiagnostics::poration_y, {1, 0, 0, 0}, on_place},
      {"poration_z", &VesicleDiagnostics::poration_z, {1, 0, 0, 0}, on_place},
  };
  return all;
}

Deviation largest_deviation(const ShortRun& base, const ShortRun& other, const UnitFactors& units,
                            Column::Depends columns_up_to) {
  if (base.stopped != other.stopped) return {std::numeric_limits<double>::infinity(), "end"};
  if (base.rows.size() != other.rows.size()) return {std::numeric_limits<double>::infinity(), "number of rows"};
  Deviation worst;
  for (const Column& column : columns()) {
    if (column.depends > columns_up_to) continue;
    const double scale = natural_scale(column, base);
    for (std::size_t i = 0; i < base.rows.size(); ++i) {
      // With a tolerance the step sizes follow an error estimate, which rounding affects.
      if (!same_time(base.rows[i].state.time * units.time, other.rows[i].state.time)) break;
      const double size = difference(column, base.rows[i], other.rows[i], column.factor(units));
      if (!(size <= worst.size * scale)) worst = {scale > 0.0 ? size / scale : size, column.name};
    }
  }
  return worst;
}

}  // namespace vehd::testing
