#include "fem_check/stiffness.hpp"

#include <algorithm>

namespace vehd::fem_check {

namespace {

/// Fields of the loops: with and without constraints.
constexpr unsigned tied_field = 0;
constexpr unsigned untied_field = 1;

/// Entries 00, 11, 22, 01, 02, 12 of a symmetric tensor.
constexpr unsigned tensor_size = 6;

/// Gauss weight times J⁻¹J⁻ᵀ at every point of every group of cells: ∫ ∇u·∇w = Σ ∂u·metric·∂w with derivatives with
/// respect to unit coordinates. Six numbers are read instead of the ten of J⁻¹ and the weight.
dealii::AlignedVector<Lanes> metric_of(const CellLoops& loops, const CellKernel& kernel) {
  constexpr unsigned entries[tensor_size][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  CellValues<1> u(loops, tied_field, kernel);
  dealii::AlignedVector<Lanes> result(std::size_t{loops.n_cell_batches()} * u.n_points() * tensor_size);
  Lanes* at = result.begin();
  for (unsigned group = 0; group < loops.n_cell_batches(); ++group) {
    u.reinit(group);
    for (unsigned q = 0; q < u.n_points(); ++q) {
      const auto inverse = u.inverse_jacobian(q);
      for (const auto& [i, j] : entries) {
        Lanes sum = 0.0;
        for (unsigned d = 0; d < 3; ++d) sum += inverse[d][i] * inverse[d][j];
        *at++ = u.weight(q) * sum;
      }
    }
  }
  return result;
}

/// to += Σ coefficient ∫ ∇u·∇w over a range of cells.
void stiffness_cells(const CellLoops& loops, unsigned field, const CellKernel& kernel,
                     const dealii::AlignedVector<Lanes>& metric, const dealii::AlignedVector<Lanes>& coefficient,
                     Distributed& to, const Distributed& from, const CellRange& range) {
  CellValues<1> u(loops, field, kernel);
  const unsigned n = u.n_points();
  for (unsigned group = range.first; group < range.second; ++group) {
    u.reinit(group);
    u.read(from);
    u.remove_constants();
    u.evaluate_gradients();
    Lanes* slope = u.slopes();
    const Lanes factor = coefficient[group];
    const Lanes* m = metric.begin() + std::size_t{group} * n * tensor_size;
    for (unsigned q = 0; q < n; ++q, m += tensor_size) {
      const Lanes a = factor * slope[q], b = factor * slope[n + q], c = factor * slope[2 * n + q];
      slope[q] = m[0] * a + m[3] * b + m[4] * c;
      slope[n + q] = m[3] * a + m[1] * b + m[5] * c;
      slope[2 * n + q] = m[4] * a + m[5] * b + m[2] * c;
    }
    u.integrate_gradients();
    u.add_to(to);
  }
}

SheetPairs pairs_of(const Space& space, const dealii::DoFHandler<3>& handler) {
  return &handler == &space.dofs ? space.trace->pairs() : sheet_pairs(space, handler);
}

/// Terms of a form on the membrane and on the outer sphere.
std::unique_ptr<SurfaceTerms> surface_terms(const Space& space, const dealii::DoFHandler<3>& handler,
                                            const Constraints& constraints, const SheetPairs& pairs,
                                            const OuterSphere& outer, const ScalarForm& form) {
  std::vector<DofIndex> dofs;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const Eigen::SparseMatrix<double>& matrix, double scale, Eigen::Index row, Eigen::Index column) {
    for (Eigen::Index j = 0; j < matrix.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, j); entry; ++entry) {
        entries.emplace_back(row + entry.row(), column + entry.col(), scale * entry.value());
      }
    }
  };
  const std::vector<double>& membranes = form.membrane.values();
  if (std::any_of(membranes.begin(), membranes.end(), [](double value) { return value != 0.0; })) {
    const auto n = static_cast<Eigen::Index>(pairs.pairs.size());
    for (const std::size_t side : {0, 1}) {
      for (const auto& pair : pairs.pairs) dofs.push_back(pair[side]);
    }
    Eigen::SparseMatrix<double> mass =
        membrane_mass(space.trace->rule(), pairs, static_cast<int>(handler.get_fe().degree)) /
        (space.length * space.length);
    // No entry couples two membranes.
    for (Eigen::Index j = 0; j < n; ++j) mass.col(j) *= form.membrane[pairs.vesicle[static_cast<std::size_t>(j)]];
    add(mass, 1.0, 0, 0);
    add(mass, 1.0, n, n);
    add(mass, -1.0, 0, n);
    add(mass, -1.0, n, 0);
  }
  if (form.robin != 0.0) {
    const auto begin = static_cast<Eigen::Index>(dofs.size());
    dofs.insert(dofs.end(), outer.dofs().begin(), outer.dofs().end());
    add(outer.mass(), form.robin, begin, begin);
  }
  Eigen::SparseMatrix<double> matrix(static_cast<Eigen::Index>(dofs.size()), static_cast<Eigen::Index>(dofs.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return std::make_unique<SurfaceTerms>(space, handler, constraints, std::move(dofs), std::move(matrix));
}

}  // namespace

Constraints make_constraints(const Space& space, const dealii::DoFHandler<3>& handler, const SheetPairs& pairs,
                             const std::vector<DofIndex>& outer_dofs, const Fixed& fixed) {
  Constraints constraints;
  constraints.reinit(dealii::complete_index_set(handler.n_dofs()));
  for (std::size_t p = 0; p < pairs.pairs.size(); ++p) {
    const Tie tie = fixed.tie[pairs.vesicle[p]];
    if (tie == Tie::none) continue;
    const auto& [inner, outer] = pairs.pairs[p];
    const bool inner_follows = tie == Tie::inner_follows_outer;
    constraints.add_line(inner_follows ? inner : outer);
    constraints.add_entry(inner_follows ? inner : outer, inner_follows ? outer : inner, 1.0);
  }
  if (fixed.outer) {
    for (const DofIndex dof : outer_dofs) constraints.add_line(dof);
  }
  if (fixed.wall) {
    for (const DofIndex dof : nodes_on(space.wall, space, handler)) constraints.add_line(dof);
  }
  if (fixed.outer_value && !constraints.is_constrained(outer_dofs.front())) constraints.add_line(outer_dofs.front());
  // The first pair of a membrane is a corner of its first face at every degree.
  for (const int vesicle : fixed.floating) constraints.add_line(pairs.first_of(vesicle)[0]);
  constraints.close();
  return constraints;
}

Stiffness::Stiffness(const Space& space, const dealii::DoFHandler<3>& handler, const Fixed& fixed,
                     const ScalarForm& form, int n_points)
    : space_(space),
      handler_(handler),
      form_(form),
      n_points_(n_points),
      kernel_(degree(), n_points),
      pairs_(pairs_of(space, handler)),
      outer_(space, handler),
      constraints_(make_constraints(space, handler, pairs_, outer_.dofs(), fixed)) {
  none_.reinit(dealii::complete_index_set(handler.n_dofs()));
  none_.close();
  loops_ = make_cell_loops(space, {{&handler, &constraints_}, {&handler, &none_}}, n_points);
  metric_ = metric_of(*loops_, kernel_);
  coefficient_ = per_cell(space, *loops_, form.inside, form.outside);
  surface_ = surface_terms(space, handler, constraints_, pairs_, outer_, form);
}

void Stiffness::vmult(Distributed& to, const Distributed& from) const {
  loops_->cell_loop<Distributed, Distributed>(
      [&](const CellLoops& loops, Distributed& t, const Distributed& f, const CellRange& range) {
        stiffness_cells(loops, tied_field, kernel_, metric_, coefficient_, t, f, range);
      },
      to, from, true);
  surface_->add({&to}, {&from});
  for (const unsigned dof : loops_->get_constrained_dofs()) to.local_element(dof) = from.local_element(dof);
}

dealii::Vector<double> Stiffness::cell_product(const dealii::Vector<double>& u,
                                               const dealii::AlignedVector<Lanes>& coefficient) const {
  Distributed from;
  Distributed product;
  loops_->initialize_dof_vector(from, untied_field);
  loops_->initialize_dof_vector(product, untied_field);
  for (const DofIndex dof : from.locally_owned_elements()) from(dof) = u[dof];
  loops_->cell_loop<Distributed, Distributed>(
      [&](const CellLoops& loops, Distributed& t, const Distributed& f, const CellRange& range) {
        stiffness_cells(loops, untied_field, kernel_, metric_, coefficient, t, f, range);
      },
      product, from, true);
  return on_all_ranks(product, space_.communicator);
}

void Stiffness::add_cells(Distributed& to, double scale, const dealii::Vector<double>& u) const {
  const dealii::Vector<double> product = cell_product(u, coefficient_);
  std::vector<DofIndex> dofs(product.size());
  Vector values(static_cast<Eigen::Index>(product.size()));
  for (DofIndex dof = 0; dof < product.size(); ++dof) {
    dofs[dof] = dof;
    values[static_cast<Eigen::Index>(dof)] = scale * product[dof];
  }
  add_at(to, dofs, values);
}

Vector Stiffness::flux_functional(const dealii::Vector<double>& u, Side side) const {
  const bool inside = side == Side::inside;
  const dealii::Vector<double> product =
      cell_product(u, per_cell(space_, *loops_, inside ? 1.0 : 0.0, inside ? 0.0 : 1.0));
  Vector result(static_cast<Eigen::Index>(pairs_.pairs.size()));
  for (std::size_t p = 0; p < pairs_.pairs.size(); ++p) {
    result[static_cast<Eigen::Index>(p)] = product[pairs_.pairs[p][inside ? 0 : 1]];
  }
  return result;
}

void Stiffness::add_at(Distributed& to, const std::vector<DofIndex>& dofs, const Vector& values) const {
  const dealii::IndexSet owned = handler_.locally_owned_dofs();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    DofIndex dof = dofs[i];
    if (constraints_.is_constrained(dof)) {
      const auto& entries = *constraints_.get_constraint_entries(dof);
      if (entries.empty()) continue;
      dof = entries.front().first;
    }
    if (owned.is_element(dof)) to(dof) += values[static_cast<Eigen::Index>(i)];
  }
}

Distributed Stiffness::inverse_diagonal() const {
  Distributed diagonal;
  initialize(diagonal);
  const CellDiagonal cells(degree(), n_points_);
  const Distributed unused(diagonal);
  loops_->cell_loop<Distributed, Distributed>(
      [&](const CellLoops& loops, Distributed& to, const Distributed&, const CellRange& range) {
        CellValues<1> u(loops, tied_field, kernel_);
        for (unsigned group = range.first; group < range.second; ++group) {
          u.reinit(group);
          const Lanes* m = metric_.begin() + std::size_t{group} * u.n_points() * tensor_size;
          std::array<dealii::AlignedVector<Lanes>, tensor_size> tensor;
          for (unsigned entry = 0; entry < tensor_size; ++entry) {
            tensor[entry].resize(u.n_points());
            for (unsigned q = 0; q < u.n_points(); ++q) tensor[entry][q] = m[q * tensor_size + entry];
          }
          const dealii::AlignedVector<Lanes> values = cells.of_stiffness(tensor);
          for (unsigned i = 0; i < u.n_nodes(); ++i) u.nodal()[i] = coefficient_[group] * values[i];
          u.add_to(to);
        }
      },
      diagonal, unused, true);
  surface_->add_diagonal(diagonal);
  for (const unsigned dof : loops_->get_constrained_dofs()) diagonal.local_element(dof) = 1.0;
  for (unsigned i = 0; i < diagonal.locally_owned_size(); ++i) {
    diagonal.local_element(i) = 1.0 / diagonal.local_element(i);
  }
  return diagonal;
}

}  // namespace vehd::fem_check
