#include "fem_check/cell_loops.hpp"

#include <deal.II/matrix_free/evaluation_template_face_factory.templates.h>
// The next header has the same include guard.
#undef dealii_matrix_free_evaluation_template_factory_templates_h
#include <deal.II/matrix_free/evaluation_template_factory.templates.h>
#include <deal.II/matrix_free/mapping_info.templates.h>
#include <deal.II/matrix_free/mapping_info_storage.templates.h>
#include <deal.II/matrix_free/matrix_free.templates.h>
#include <deal.II/matrix_free/shape_info.templates.h>

// The compiled library contains these loops for single cells only.
template class dealii::MatrixFree<3, double, vehd::fem_check::Lanes>;

namespace vehd::fem_check {

namespace {

/// Contracts the first index of `data` with every row of `matrix`; the new index becomes the last one.
dealii::AlignedVector<Lanes> contract_first(const Eigen::MatrixXd& matrix, const dealii::AlignedVector<Lanes>& data) {
  const auto n_in = static_cast<unsigned>(matrix.cols());
  const auto n_out = static_cast<unsigned>(matrix.rows());
  const unsigned rest = data.size() / n_in;
  dealii::AlignedVector<Lanes> result(rest * n_out);
  for (unsigned i = 0; i < n_out; ++i) {
    for (unsigned r = 0; r < rest; ++r) {
      Lanes sum = 0.0;
      for (unsigned j = 0; j < n_in; ++j) sum += data[r * n_in + j] * matrix(i, j);
      result[i * rest + r] = sum;
    }
  }
  return result;
}

}  // namespace

std::shared_ptr<const CellLoops> make_cell_loops(const Space& space, const std::vector<CellField>& fields,
                                                 int n_points) {
  std::vector<const dealii::DoFHandler<3>*> dofs;
  std::vector<const Constraints*> constraints;
  for (const CellField& field : fields) {
    dofs.push_back(field.dofs);
    constraints.push_back(field.constraints);
  }
  CellLoops::AdditionalData data;
  data.tasks_parallel_scheme = CellLoops::AdditionalData::none;
  data.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
  const auto loops = std::make_shared<CellLoops>();
  loops->reinit(space.mapping, dofs, constraints,
                std::vector<dealii::Quadrature<1>>{dealii::QGauss<1>(static_cast<unsigned>(n_points))}, data);
  return loops;
}

dealii::AlignedVector<Lanes> per_cell(const Space& space, const CellLoops& loops, const PerVesicle<double>& inside,
                                      double outside) {
  dealii::AlignedVector<Lanes> result(loops.n_cell_batches());
  for (unsigned group = 0; group < loops.n_cell_batches(); ++group) {
    Lanes value = outside;
    for (unsigned lane = 0; lane < loops.n_active_entries_per_cell_batch(group); ++lane) {
      const auto cell = static_cast<unsigned>(loops.get_cell_iterator(group, lane)->index());
      if (space.inside(cell)) value[lane] = inside[space.vesicle(cell)];
    }
    result[group] = value;
  }
  return result;
}

CellDiagonal::CellDiagonal(int degree, int n_points) {
  const dealii::QGauss<1> gauss(static_cast<unsigned>(n_points));
  const auto polynomials = edge_polynomials(static_cast<unsigned>(degree));
  for (auto& matrix : products_) matrix.resize(degree + 1, n_points);
  std::vector<double> derivatives(2);
  for (int i = 0; i <= degree; ++i) {
    for (int q = 0; q < n_points; ++q) {
      polynomials[i].value(gauss.point(static_cast<unsigned>(q))[0], derivatives);
      products_[0](i, q) = derivatives[0] * derivatives[0];
      products_[1](i, q) = derivatives[0] * derivatives[1];
      products_[2](i, q) = derivatives[1] * derivatives[1];
    }
  }
}

dealii::AlignedVector<Lanes> CellDiagonal::of_mass(const dealii::AlignedVector<Lanes>& coefficient) const {
  return contract_first(products_[0], contract_first(products_[0], contract_first(products_[0], coefficient)));
}

dealii::AlignedVector<Lanes> CellDiagonal::of_stiffness(
    const std::array<dealii::AlignedVector<Lanes>, 6>& tensor) const {
  // Number of derivatives in each direction for each entry; off-diagonal entries occur twice.
  constexpr int orders[6][3] = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}};
  dealii::AlignedVector<Lanes> result;
  for (int entry = 0; entry < 6; ++entry) {
    dealii::AlignedVector<Lanes> term = tensor[entry];
    for (const int order : orders[entry]) term = contract_first(products_[order], term);
    if (entry == 0) {
      result = term;
    } else {
      const double factor = entry < 3 ? 1.0 : 2.0;
      for (unsigned i = 0; i < result.size(); ++i) result[i] += factor * term[i];
    }
  }
  return result;
}

}  // namespace vehd::fem_check
