#include "fem_check/stokes_cells.hpp"

namespace vehd::fem_check {

namespace {

constexpr unsigned velocity_field = 0;
constexpr unsigned pressure_field = 1;

}  // namespace

StokesCells::StokesCells(const Space& space, const dealii::DoFHandler<3>& pressure_dofs,
                         const Constraints& velocity_constraints, const PerVesicle<double>& viscosity_inside)
    : space_(space),
      degree_(static_cast<int>(space.element.degree)),
      velocity_kernel_(degree_, points_per_direction(degree_)),
      pressure_kernel_(degree_ - 1, points_per_direction(degree_)) {
  none_.reinit(dealii::complete_index_set(pressure_dofs.n_dofs()));
  none_.close();
  loops_ = make_cell_loops(space, {{&space.dofs, &velocity_constraints}, {&pressure_dofs, &none_}},
                           points_per_direction(degree_));
  // Only differences matter: a contrast that is equal everywhere would leave only a term on the outer sphere.
  contrast_outside_ = 0.0;
  for (const double inside : viscosity_inside.values()) contrast_outside_ = std::max(contrast_outside_, 1.0 - inside);
  const auto on_each = [&](const auto& of_viscosity) {
    return per_vesicle(space.n_vesicles, [&](int vesicle) { return double(of_viscosity(viscosity_inside[vesicle])); });
  };
  viscosity_ = per_cell(space, *loops_, viscosity_inside, 1.0);
  contrast_ = per_cell(space, *loops_, on_each([&](double inside) { return inside - 1.0 + contrast_outside_; }),
                       contrast_outside_);
  fluidity_ = per_cell(space, *loops_, on_each([](double inside) { return 1.0 / inside; }), 1.0);
}

void StokesCells::apply(const Parts& to, const Parts& from) const {
  loops_->cell_loop<Parts, Parts>(
      [&](const CellLoops& loops, Parts& t, const Parts& f, const CellRange& range) {
        CellValues<3> velocity(loops, velocity_field, velocity_kernel_);
        CellValues<1> pressure(loops, pressure_field, pressure_kernel_);
        for (unsigned group = range.first; group < range.second; ++group) {
          velocity.reinit(group);
          velocity.read(f);
          velocity.remove_constants();
          velocity.evaluate_gradients();
          pressure.reinit(group);
          pressure.read(*f[3]);
          pressure.evaluate_values();
          for (unsigned q = 0; q < velocity.n_points(); ++q) {
            const auto gradient = velocity.gradient(q);  // [component][direction]
            const Lanes p = pressure.value(q);
            auto flux = gradient;
            Lanes divergence = 0.0;
            for (unsigned a = 0; a < 3; ++a) {
              for (unsigned b = 0; b < 3; ++b) {
                flux[a][b] = viscosity_[group] * gradient[a][b] + contrast_[group] * gradient[b][a];
              }
              flux[a][a] -= p;
              divergence += gradient[a][a];
            }
            velocity.submit_gradient(flux, q);
            pressure.submit_value(-divergence, q);
          }
          velocity.integrate_gradients();
          velocity.add_to(t);
          pressure.integrate_values();
          pressure.add_to(*t[3]);
        }
      },
      const_cast<Parts&>(to), from, true);
}

void StokesCells::apply_divergence(Distributed& to, const Parts& from) const {
  loops_->cell_loop<Distributed, Parts>(
      [&](const CellLoops& loops, Distributed& t, const Parts& f, const CellRange& range) {
        CellValues<3> velocity(loops, velocity_field, velocity_kernel_);
        CellValues<1> pressure(loops, pressure_field, pressure_kernel_);
        for (unsigned group = range.first; group < range.second; ++group) {
          velocity.reinit(group);
          velocity.read(f);
          velocity.evaluate_gradients();
          pressure.reinit(group);
          for (unsigned q = 0; q < velocity.n_points(); ++q) {
            const auto gradient = velocity.gradient(q);
            pressure.submit_value(-(gradient[0][0] + gradient[1][1] + gradient[2][2]), q);
          }
          pressure.integrate_values();
          pressure.add_to(t);
        }
      },
      to, from, true);
}

void StokesCells::apply_pressure_mass(Distributed& to, const Distributed& from) const {
  loops_->cell_loop<Distributed, Distributed>(
      [&](const CellLoops& loops, Distributed& t, const Distributed& f, const CellRange& range) {
        CellValues<1> pressure(loops, pressure_field, pressure_kernel_);
        for (unsigned group = range.first; group < range.second; ++group) {
          pressure.reinit(group);
          pressure.read(f);
          pressure.evaluate_values();
          for (unsigned q = 0; q < pressure.n_points(); ++q) {
            pressure.submit_value(fluidity_[group] * pressure.value(q), q);
          }
          pressure.integrate_values();
          pressure.add_to(t);
        }
      },
      to, from, true);
}

Distributed StokesCells::inverse_pressure_diagonal() const {
  Distributed diagonal;
  initialize_pressure(diagonal);
  const Distributed unused(diagonal);
  const CellDiagonal cells(degree_ - 1, points_per_direction(degree_));
  loops_->cell_loop<Distributed, Distributed>(
      [&](const CellLoops& loops, Distributed& to, const Distributed&, const CellRange& range) {
        CellValues<1> pressure(loops, pressure_field, pressure_kernel_);
        dealii::AlignedVector<Lanes> weight(pressure.n_points());
        for (unsigned group = range.first; group < range.second; ++group) {
          pressure.reinit(group);
          for (unsigned q = 0; q < pressure.n_points(); ++q) weight[q] = fluidity_[group] * pressure.weight(q);
          const dealii::AlignedVector<Lanes> values = cells.of_mass(weight);
          for (unsigned i = 0; i < pressure.n_nodes(); ++i) pressure.nodal()[i] = values[i];
          pressure.add_to(to);
        }
      },
      diagonal, unused, true);
  for (unsigned i = 0; i < diagonal.locally_owned_size(); ++i) {
    diagonal.local_element(i) = 1.0 / diagonal.local_element(i);
  }
  return diagonal;
}

}  // namespace vehd::fem_check
