#pragma once

#include <memory>
#include <vector>

#include "bie/physics/membrane.hpp"
#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/sphere/symmetry.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/support/instruments.hpp"
#include "bie/support/ranks/partition.hpp"

namespace vehd {

/// Numerical settings of a run; the defaults are the program's defaults.
struct NumericalSettings {
  int order = 16;                         ///< p
  int time_order = 1;                     ///< order of a step in dt, 1 … highest_time_order
  int upsampling = 2;                     ///< nonlinear terms are evaluated on the grid of order upsampling * p
  int longitude_fold = 1;                 ///< every grid is its own image under turns by 2π/fold about z
  bool beside_wall = false;               ///< there is a wall: even a single vesicle has layers of its image
  double quadrature_oversampling = 1.15;  ///< nodes of the singular quadrature in θ per degree
  double quadrature_tolerance = 1e-4;     ///< of LayerCheck::error, above which the quadrature is refined
  double flow_tolerance = 1e-9;           ///< of the tension and velocity solves
  double electric_tolerance = 1e-10;      ///< of the charge-density and charging solves
  double constraint_tolerance = 1e-9;     ///< of area and volume, relative, at the end of a step
  double curvature_tolerance = 1e-5;      ///< of Eq. (28), relative to the step's own curvature change
  double strain_tolerance = 1e-6;         ///< of the resolved local strain
};

/// Degree, grids and singular quadrature of one membrane. Immutable.
class MembraneSpace {
 public:
  /// @param settings  with the degree and the oversampling of this membrane
  /// @param symmetry  of every state of the run: only independent entries are computed
  MembraneSpace(const NumericalSettings& settings, const Symmetry& symmetry);

  [[nodiscard]] int order() const { return whole_.order(); }
  [[nodiscard]] const SymmetrySubspace& subspace() const { return subspace_; }
  /// Transform between degree p and the grid of order p with all its longitudes; only with m = 0 and ±1 for
  /// axisymmetric states.
  [[nodiscard]] const SphereTransform& transform() const { return whole_; }
  /// Transform between degree p and the grid of order p on the longitudes that the symmetry leaves: the targets of the
  /// layers.
  [[nodiscard]] const SphereTransform& targets() const { return targets_; }
  /// Transform between degree p and the upsampled grid; four longitudes if axisymmetric.
  [[nodiscard]] const SphereTransform& fine_transform() const { return fine_; }
  /// Transform between the upsampled grid and the degree of changes of H in implicit steps, see FlowOptions: p + 1,
  /// since positions of degree p have normal parts of the next degree.
  [[nodiscard]] const SphereTransform& curvature_transform() const { return curvature_; }
  /// Symmetry of fields of that degree.
  [[nodiscard]] const SymmetrySubspace& curvature_subspace() const { return curvature_subspace_; }
  /// Singular quadrature about the targets.
  [[nodiscard]] const RotatedQuadrature& quadrature() const { return quadrature_; }
  /// States and longitudes of the targets are invariant under turns by 2π/fold about z.
  [[nodiscard]] int fold() const { return fold_; }

 private:
  SymmetrySubspace subspace_;
  SphereTransform whole_;
  SphereTransform targets_;
  SphereTransform fine_;
  SphereTransform curvature_;
  SymmetrySubspace curvature_subspace_;
  RotatedQuadrature quadrature_;
  int fold_;
};

/// Resolution of one membrane.
struct ResolutionLevel {
  int order = 16;                      ///< degree p
  double quadrature_refinement = 1.0;  ///< nodes of the singular quadrature, relative to those of the settings
};

/// The spaces of all vesicles, their common settings, and the distribution of the vesicles over ranks. Immutable;
/// copies share the spaces.
class Discretisation {
 public:
  /// One vesicle with the degree and the quadrature of the settings.
  explicit Discretisation(const NumericalSettings& settings, const Symmetry& symmetry = {});
  /// Vesicles each with its own degree and quadrature.
  /// @param ranks  that compute together; a single vesicle is computed by each of them
  Discretisation(const NumericalSettings& settings, const Symmetry& symmetry,
                 const std::vector<ResolutionLevel>& vesicles, const Ranks& ranks = {});

  /// This discretisation with another level for one vesicle.
  [[nodiscard]] Discretisation with(std::size_t vesicle, const ResolutionLevel& level) const;

  [[nodiscard]] const NumericalSettings& settings() const { return settings_; }
  [[nodiscard]] const Symmetry& symmetry() const { return symmetry_; }
  /// Space of one vesicle.
  [[nodiscard]] const MembraneSpace& vesicle(std::size_t a) const { return *vesicles_[a]; }
  [[nodiscard]] std::size_t n_vesicles() const { return vesicles_.size(); }
  /// Which rank has the operators of which vesicle.
  [[nodiscard]] const Partition& partition() const { return partition_; }
  /// Transforms that layers between the vesicles need at every step, as far as they need little memory.
  [[nodiscard]] const SharedTransforms& pair_transforms() const { return pair_transforms_; }
  /// Is one state too little work for all threads, so that each should have a state of its own? Never with several
  /// ranks, which wait for each other.
  [[nodiscard]] bool leaves_threads_idle() const;

 private:
  void prepare_pairs(const Ranks& ranks);
  [[nodiscard]] std::shared_ptr<const MembraneSpace> space_of(const ResolutionLevel& level) const;

  NumericalSettings settings_;
  Symmetry symmetry_;
  std::vector<std::shared_ptr<const MembraneSpace>> vesicles_;
  Partition partition_;
  SharedTransforms pair_transforms_;
};

/// The membrane at a position with the selected operators; it can outlive the space. A viscosity contrast replaces the
/// double layer from which it is built.
/// @param position  coefficients, [n_coefficients x 3]
Membrane membrane_at(const MembraneSpace& space, const Matrix& position, const LayerSelection& selection,
                     double viscosity_ratio, Instruments& instruments);

/// Spatially varying properties as values on the upsampled grid, for a Membrane.
/// @param coefficients  of the degree of the space
MembraneMaterial material_at(const MembraneSpace& space, const MembraneMaterial& coefficients);

}  // namespace vehd
