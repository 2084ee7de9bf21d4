#pragma once

#include <array>
#include <vector>

#include "bie/kernels/no_slip.hpp"
#include "bie/kernels/stokes.hpp"
#include "bie/potentials/smooth_grid.hpp"
#include "bie/potentials/target_frame.hpp"

namespace vehd {

/// A layer of one membrane at points of another; N is the normal there.
enum class PairLayer : std::size_t {
  laplace_single,         ///< S[f] from J f
  laplace_single_normal,  ///< N·∇S[f] from J f: S′ where source and target are the same membrane
  laplace_double,         ///< D[f] from f
  laplace_double_normal,  ///< N·∇D[f] from f
  stokes_single,          ///< of J f at μ = 1, three components
  stokes_double,          ///< of v, with the kernel stokes_double_kernel
  no_slip_single,         ///< of J f at μ = 1, image in a no-slip plane with the kernel no_slip_flow
  no_slip_double          ///< of v, image in a no-slip plane with the kernel no_slip_double_flow
};
constexpr std::size_t n_pair_layers = 8;
constexpr bool is_stokes(PairLayer layer) { return layer >= PairLayer::stokes_single; }
constexpr bool is_no_slip(PairLayer layer) { return layer >= PairLayer::no_slip_single; }
/// Number of rows: one for a scalar layer, six (xx, xy, xz, yy, yz, zz) for a Stokes layer, nine for an image.
constexpr int n_rows(PairLayer layer) { return is_no_slip(layer) ? 9 : is_stokes(layer) ? 6 : 1; }
/// The row of a layer with three components that takes component j of the density to component i.
constexpr int row_of_block(PairLayer layer, int i, int j) { return is_no_slip(layer) ? 3 * i + j : kStokesBlock[i][j]; }

/// Selected layers, in the order of PairLayer.
struct PairSelection {
  bool laplace_single = false;
  bool laplace_single_normal = false;
  bool laplace_double = false;
  bool laplace_double_normal = false;
  bool stokes_single = false;
  bool stokes_double = false;
  bool no_slip_single = false;
  bool no_slip_double = false;
};

/// No-slip plane of the images, for targets that are mirrored and hence beyond it; other layers ignore it.
struct MirrorPlane {
  Vector3 point = Vector3::Zero(), normal = Vector3::Zero();

  [[nodiscard]] MirroredTarget target(const Vector3& x) const { return {normal, normal.dot(point - x)}; }
};

/// First row of each layer, see n_rows; −1 for a layer that is not selected.
struct PairColumns {
  std::array<int, n_pair_layers> first;
  int count = 0;

  explicit PairColumns(const PairSelection& selection);
  [[nodiscard]] int operator[](PairLayer layer) const { return first[static_cast<std::size_t>(layer)]; }
  [[nodiscard]] bool has(PairLayer layer) const { return (*this)[layer] >= 0; }
};

/// Layers at one target outside the membrane as rows over the coefficients of their densities.
struct NearRows {
  RowMatrix rows;          ///< [PairColumns::count x n_coefficients], with prefactors, Stokes single layer at μ = 1
  double enclosure = 0.0;  ///< D[1] by the same nodes, 0 in exact arithmetic
};

/// The kernels at the nodes of a rule about the foot point of the target, converted to rows over coefficients by the
/// adjoint of "rotation, synthesis". Single layers act on J f, double layers on f; the latter are those of f − f(foot),
/// which outside are the complete layers.
/// @param frame   of the membrane, its pole at the foot of the target; fields without densities
/// @param offset  target minus foot
/// @param normal  N at the target
/// @param mirrored  the target relative to the plane, for images
/// Accuracy: rounding of the rule's sums; the rows agree with OffSurfaceLayers to 1e-9
/// (tests/potentials/pair_layers_test.cpp)
/// Source: paper Eqs. (6), (8), (9); stokes_double_kernel; no_slip_flow
NearRows near_rows(const TargetFrame& frame, const GradedRule& rule, const Vector3& offset, const Vector3& normal,
                   const MirroredTarget& mirrored, const PairColumns& columns);

/// A membrane and the points outside it at which its layers are evaluated.
struct PairGeometry {
  Matrix source;           ///< coefficients of the membrane, [n_coefficients x 3]
  Matrix points, normals;  ///< of the targets, [n_targets x 3]
  LayerFields fields;      ///< of the membrane, without densities
  SmoothGrid grid;         ///< from which nearest points are searched
  MirrorPlane plane{};     ///< for images

  [[nodiscard]] Vector3 point(Index i) const { return points.row(i).transpose(); }
  [[nodiscard]] Vector3 normal(Index i) const { return normals.row(i).transpose(); }
};

/// Accuracy required of the rules about the nearest points, see PairSettings.
struct NearRowSettings {
  double tolerance;
  int max_rules;
};

/// Rows over the coefficients of the densities at targets near a membrane, each by the graded rule about its nearest
/// point; targets with equal rules share tables.
/// @param targets  which of the points, in ascending order
/// @return         [n_coefficients x targets.size() * PairColumns::count], the rows of each target as columns
/// @throws ConvergenceError if the nearest point of a target is not found, a target is not outside the membrane, or the
/// rules do not converge
/// Accuracy: the tolerance relative to the largest entry of each layer (tests/potentials/pair_layers_test.cpp)
/// Source: near_rows
Matrix rows_of_near_targets(const PairGeometry& at, const std::vector<Index>& targets, const PairColumns& columns,
                            const NearRowSettings& settings);

}  // namespace vehd
