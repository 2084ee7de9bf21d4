#include "bie/stepping/space/discretisation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "bie/potentials/pair_layers.hpp"

namespace vehd {

namespace {

/// Largest Stokes layers, in entries, with which each thread works on its own node of the step or snapshot. Larger ones
/// keep all threads busy with one state, and two would not fit the caches. Measured.
constexpr double most_entries_of_small_operators = 1e6;

/// Degree up to which transforms for layers between vesicles are kept: about 20 MB.
constexpr int kHighestPrepared = 32;

/// The least even number of longitudes that integrates products of harmonics and whose set the turns map onto itself; a
/// few more if that makes transforms fast.
int n_longitudes(int grid_order, int fold, bool fast) {
  const int step = std::lcm(2, fold), least = 2 * grid_order + 2;
  return fast ? fast_longitudes(least, step) : step * ((least + step - 1) / step);
}

/// Cartesian components of axisymmetric vectors have the modes m = 0 and ±1 only.
SphereTransform transform_for(const Symmetry& symmetry, const NumericalSettings& settings, int grid_order, bool fast) {
  if (symmetry.axisymmetric) return {settings.order, make_grid(grid_order, 4), 1};
  const int fold = std::lcm(std::lcm(symmetry.fold, symmetry.exchange.fold()), settings.longitude_fold);
  return {settings.order, make_grid(grid_order, n_longitudes(grid_order, fold, fast))};
}

SphereTransform curvature_transform_on(const SphereTransform& fine) {
  // A grid that is not upsampled cannot resolve the next degree.
  const int order = std::min(fine.order() + 1, fine.grid().order);
  const int azimuthal_order = fine.azimuthal_order() == fine.order() ? order : fine.azimuthal_order();
  return {order, fine.grid(), azimuthal_order};
}

}  // namespace

MembraneSpace::MembraneSpace(const NumericalSettings& settings, const Symmetry& symmetry)
    : subspace_(symmetry, settings.order),
      whole_(settings.order, make_grid(settings.order), symmetry.axisymmetric ? 1 : settings.order),
      // No further longitudes for fast transforms: each node is a target, which costs more.
      targets_(transform_for(symmetry, settings, settings.order, false)),
      fine_(transform_for(symmetry, settings, settings.upsampling * settings.order, true)),
      curvature_(curvature_transform_on(fine_)),
      curvature_subspace_(symmetry, curvature_.order()),
      quadrature_(make_rotated_quadrature(targets_.grid(), settings.quadrature_oversampling)),
      fold_(symmetry.axisymmetric ? targets_.grid().n_phi : symmetry.fold) {}

Discretisation::Discretisation(const NumericalSettings& settings, const Symmetry& symmetry)
    : Discretisation(settings, symmetry, {{settings.order, 1.0}}) {}

Discretisation::Discretisation(const NumericalSettings& settings, const Symmetry& symmetry,
                               const std::vector<ResolutionLevel>& vesicles, const Ranks& ranks)
    : settings_(settings), symmetry_(symmetry) {
  for (const ResolutionLevel& level : vesicles) vesicles_.push_back(space_of(level));
  prepare_pairs(ranks);
}

/// Prepares transforms for pairs, and distributes the vesicles over ranks by the sizes of their operators.
void Discretisation::prepare_pairs(const Ranks& ranks) {
  if (n_vesicles() < 2 && !settings_.beside_wall) return;
  for (const auto& space : vesicles_) {
    // Tables grow with the cube of the degree, while the share of transforms in a step falls.
    if (space->order() <= kHighestPrepared) prepare_pair_transforms(space->order(), pair_transforms_);
  }
  if (n_vesicles() < 2) return;
  std::vector<double> costs;
  for (const auto& space : vesicles_) costs.push_back(std::pow(space->order() + 1.0, 4));
  partition_ = Partition(ranks, costs, symmetry_.exchange.originals());
}

Discretisation Discretisation::with(std::size_t vesicle, const ResolutionLevel& level) const {
  Discretisation result = *this;
  result.vesicles_[vesicle] = space_of(level);
  result.prepare_pairs(partition_.ranks());
  return result;
}

bool Discretisation::leaves_threads_idle() const {
  double entries = 0.0;
  for (const auto& space : vesicles_) {
    const auto of_velocity = static_cast<double>(space->subspace().vectors().size());
    entries += of_velocity * of_velocity;
  }
  return partition_.ranks().is_alone() && entries <= most_entries_of_small_operators;
}

std::shared_ptr<const MembraneSpace> Discretisation::space_of(const ResolutionLevel& level) const {
  NumericalSettings settings = settings_;
  settings.order = level.order;
  settings.quadrature_oversampling *= level.quadrature_refinement;
  return std::make_shared<const MembraneSpace>(settings, symmetry_);
}

Membrane membrane_at(const MembraneSpace& space, const Matrix& position, const LayerSelection& selection,
                     double viscosity_ratio, Instruments& instruments) {
  const SymmetrySubspace& subspace = space.subspace();
  Surface surface = make_surface(space.fine_transform(), position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  LayerOperators layers = assemble_symmetric_operators(space.quadrature(), space.targets(), position, selection,
                                                       instruments, subspace, space.fold());
  std::optional<ViscosityContrast> contrast;
  if (selection.stokes_double) {
    contrast.emplace(ViscosityContrastParameters{viscosity_ratio}, space.fine_transform(), surface,
                     layers.stokes_double, subspace);
    layers.stokes_double = {};
  }
  return {space.fine_transform(), std::move(surface), std::move(layers), radius, subspace, std::move(contrast)};
}

MembraneMaterial material_at(const MembraneSpace& space, const MembraneMaterial& coefficients) {
  MembraneMaterial values = coefficients;
  for_each_property(values, [&](Vector& property) { property = Vector(space.fine_transform().synthesize(property)); });
  return values;
}

}  // namespace vehd
