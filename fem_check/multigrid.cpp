#include "fem_check/multigrid.hpp"

namespace vehd::fem_check {

namespace {

using Smoother = dealii::PreconditionChebyshev<Stiffness, Distributed, dealii::DiagonalMatrix<Distributed>>;
using Transfer = dealii::MGTransferGlobalCoarsening<3, Distributed>;

/// Degrees of the levels from coarsest to finest.
std::vector<int> degrees_of_levels(int degree) {
  std::vector<int> degrees;
  for (; degree >= 1; degree /= 2) degrees.insert(degrees.begin(), degree);
  return degrees;
}

class LevelMatrices : public dealii::MGMatrixBase<Distributed> {
 public:
  explicit LevelMatrices(const std::vector<std::unique_ptr<Stiffness>>& levels) : levels_(levels) {}
  void vmult(const unsigned level, Distributed& to, const Distributed& from) const override {
    levels_[level]->vmult(to, from);
  }
  void vmult_add(const unsigned level, Distributed& to, const Distributed& from) const override {
    Distributed product(to);
    vmult(level, product, from);
    to += product;
  }
  void Tvmult(const unsigned level, Distributed& to, const Distributed& from) const override { vmult(level, to, from); }
  void Tvmult_add(const unsigned level, Distributed& to, const Distributed& from) const override {
    vmult_add(level, to, from);
  }
  [[nodiscard]] unsigned get_minlevel() const override { return 0; }
  [[nodiscard]] unsigned get_maxlevel() const override { return static_cast<unsigned>(levels_.size()) - 1; }

 private:
  const std::vector<std::unique_ptr<Stiffness>>& levels_;
};

class LevelSmoothers : public dealii::MGSmootherBase<Distributed> {
 public:
  explicit LevelSmoothers(const std::vector<std::unique_ptr<Smoother>>& smoothers) : smoothers_(smoothers) {}
  void clear() override {}
  void smooth(const unsigned level, Distributed& u, const Distributed& b) const override {
    smoothers_[level]->step(u, b);
  }
  void apply(const unsigned level, Distributed& u, const Distributed& b) const override {
    smoothers_[level]->vmult(u, b);
  }

 private:
  const std::vector<std::unique_ptr<Smoother>>& smoothers_;
};

/// Direct solver of the coarsest level, complete on every rank.
class CoarseSolver : public dealii::MGCoarseGridBase<Distributed> {
 public:
  explicit CoarseSolver(const Stiffness& level) : communicator_(level.space().communicator) {
    const Space& space = level.space();
    const dealii::DoFHandler<3>& handler = level.handler();
    const auto n = static_cast<Eigen::Index>(handler.n_dofs());
    // Free degree of freedom to which each one is tied, or −1 if it is fixed.
    std::vector<Eigen::Index> free(handler.n_dofs());
    std::vector<Eigen::Triplet<double>> entries;
    for (DofIndex dof = 0; dof < handler.n_dofs(); ++dof) {
      free[dof] = static_cast<Eigen::Index>(dof);
      if (!level.constraints().is_constrained(dof)) continue;
      const auto& masters = *level.constraints().get_constraint_entries(dof);
      free[dof] = masters.empty() ? -1 : static_cast<Eigen::Index>(masters.front().first);
      entries.emplace_back(dof, dof, 1.0);
    }
    const auto add = [&](DofIndex row, DofIndex column, double value) {
      if (free[row] >= 0 && free[column] >= 0) entries.emplace_back(free[row], free[column], value);
    };
    const auto degree = static_cast<int>(handler.get_fe().degree);
    dealii::FEValues<3> fe(space.mapping, handler.get_fe(),
                           dealii::QGauss<3>(static_cast<unsigned>(points_per_direction(degree))),
                           dealii::update_gradients | dealii::update_JxW_values);
    std::vector<DofIndex> dofs(fe.dofs_per_cell);
    for (const auto& cell : handler.active_cell_iterators()) {
      fe.reinit(cell);
      cell->get_dof_indices(dofs);
      const auto index = static_cast<unsigned>(cell->index());
      const double coefficient = space.inside(index) ? level.form().inside[space.vesicle(index)] : level.form().outside;
      for (unsigned i = 0; i < dofs.size(); ++i) {
        for (unsigned j = 0; j < dofs.size(); ++j) {
          double sum = 0.0;
          for (unsigned q = 0; q < fe.n_quadrature_points; ++q) {
            sum += fe.JxW(q) * (fe.shape_grad(i, q) * fe.shape_grad(j, q));
          }
          add(dofs[i], dofs[j], coefficient * sum);
        }
      }
    }
    const Eigen::SparseMatrix<double>& surface = level.surface().matrix();
    for (Eigen::Index j = 0; j < surface.outerSize(); ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(surface, j); entry; ++entry) {
        const DofIndex row = level.surface().dofs()[static_cast<std::size_t>(entry.row())];
        const DofIndex column = level.surface().dofs()[static_cast<std::size_t>(entry.col())];
        if (!level.constraints().is_constrained(row) && !level.constraints().is_constrained(column)) {
          add(row, column, entry.value());
        }
      }
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(matrix);
    if (factors_.info() != Eigen::Success) throw SolveError("the coarsest matrix is not positive definite");
  }

  void operator()(const unsigned /*level*/, Distributed& to, const Distributed& from) const override {
    Vector values = Vector::Zero(static_cast<Eigen::Index>(from.size()));
    for (const DofIndex dof : from.locally_owned_elements()) values[static_cast<Eigen::Index>(dof)] = from(dof);
    const dealii::ArrayView<double> all(values.data(), from.size());
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(all), communicator_, all);
    const Vector solution = factors_.solve(values);
    for (const DofIndex dof : to.locally_owned_elements()) to(dof) = solution[static_cast<Eigen::Index>(dof)];
  }

 private:
  MPI_Comm communicator_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factors_;
};

Smoother::AdditionalData smoother_data(const Stiffness& level) {
  Smoother::AdditionalData data;
  data.degree = 2;
  data.smoothing_range = 8.0;
  data.eig_cg_n_iterations = 15;
  data.preconditioner = std::make_shared<dealii::DiagonalMatrix<Distributed>>();
  data.preconditioner->get_vector() = level.inverse_diagonal();
  data.constraints.copy_from(level.constraints());
  return data;
}

}  // namespace

struct Multigrid::Implementation {
  std::vector<std::unique_ptr<dealii::DoFHandler<3>>> handlers;  // of all levels but the finest
  std::vector<std::unique_ptr<Stiffness>> levels;
  std::vector<std::unique_ptr<Smoother>> smoothers;
  std::unique_ptr<CoarseSolver> coarse;
  std::unique_ptr<LevelMatrices> matrices;
  std::unique_ptr<LevelSmoothers> smooth;
  // Recent versions of deal.II keep pointers to these objects.
  dealii::MGLevelObject<dealii::MGTwoLevelTransfer<3, Distributed>> transfers;
  std::unique_ptr<Transfer> transfer;
  std::unique_ptr<dealii::Multigrid<Distributed>> cycle;
  std::unique_ptr<dealii::PreconditionMG<3, Distributed, Transfer>> preconditioner;
};

Multigrid::Multigrid(const Space& space, const Fixed& fixed, const ScalarForm& form, Finest use_of_finest)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& mg = *implementation_;
  const std::vector<int> degrees = degrees_of_levels(static_cast<int>(space.element.degree));
  const auto finest = static_cast<unsigned>(degrees.size()) - 1;
  for (unsigned level = 0; level < finest; ++level) {
    mg.handlers.push_back(std::make_unique<dealii::DoFHandler<3>>(space.triangulation));
    mg.handlers.back()->distribute_dofs(dealii::FE_Q<3>(static_cast<unsigned>(degrees[level])));
  }
  for (unsigned level = 0; level <= finest; ++level) {
    const dealii::DoFHandler<3>& handler = level == finest ? space.dofs : *mg.handlers[level];
    const bool solves = level == finest && use_of_finest == Finest::solves;
    const int n_points =
        solves ? points_per_direction(degrees[level]) : preconditioner_points_per_direction(degrees[level]);
    mg.levels.push_back(std::make_unique<Stiffness>(space, handler, fixed, form, n_points));
    mg.smoothers.push_back(std::make_unique<Smoother>());
    if (level > 0) mg.smoothers.back()->initialize(*mg.levels[level], smoother_data(*mg.levels[level]));
  }
  mg.coarse = std::make_unique<CoarseSolver>(*mg.levels.front());
  mg.transfers.resize(0, finest);
  for (unsigned level = 1; level <= finest; ++level) {
    const Stiffness& fine = *mg.levels[level];
    const Stiffness& coarse = *mg.levels[level - 1];
    mg.transfers[level].reinit_polynomial_transfer(fine.handler(), coarse.handler(), fine.constraints(),
                                                   coarse.constraints());
  }
  mg.transfer = std::make_unique<Transfer>(
      mg.transfers, [&](unsigned level, Distributed& vector) { mg.levels[level]->initialize(vector); });
  mg.matrices = std::make_unique<LevelMatrices>(mg.levels);
  mg.smooth = std::make_unique<LevelSmoothers>(mg.smoothers);
  mg.cycle =
      std::make_unique<dealii::Multigrid<Distributed>>(*mg.matrices, *mg.coarse, *mg.transfer, *mg.smooth, *mg.smooth);
  mg.preconditioner =
      std::make_unique<dealii::PreconditionMG<3, Distributed, Transfer>>(space.dofs, *mg.cycle, *mg.transfer);
}

Multigrid::~Multigrid() = default;

void Multigrid::vmult(Distributed& to, const Distributed& from) const {
  implementation_->preconditioner->vmult(to, from);
}

const Stiffness& Multigrid::finest() const { return *implementation_->levels.back(); }

}  // namespace vehd::fem_check
