#pragma once

#include <array>

#include "bie/support/types.hpp"

namespace vehd {

/// Limit of a potential at a point on the membrane. The side of other points follows from their position.
enum class Side { interior, exterior, principal_value };

/// Column of each field in a block of quadrature nodes: the position y, its tangents y_1, y_2 in the frame of the unit
/// sphere, and the densities that the layers need; −1 if absent.
struct NodeColumns {
  int position = 0;   ///< 3 columns
  int tangent_1 = 3;  ///< 3 columns
  int tangent_2 = 6;  ///< 3 columns
  int single = -1, double_layer = -1, double_1 = -1, double_2 = -1;
  int stokes = -1, stokes_double = -1;  ///< 3 columns each
  int count = 9;
  bool single_gradient = false;
  bool plain = false;  ///< densities of the single layers are f until weigh_densities()
};

/// The layers at one target; scalar ones are in the first component.
struct LayersAt {
  enum Layer : std::size_t {
    single,           ///< ∫ (J f)/|r| dω
    single_gradient,  ///< −∫ (J f) r/|r|³ dω
    double_layer,     ///< ∫ f r·J n/|r|³ dω
    double_gradient,  ///< −∫ r/|r|³ × (J n×∇_γ f) dω
    stokes,           ///< ∫ (I/|r| + r rᵀ/|r|³)(J f) dω
    stokes_double,    ///< ∫ r rᵀ v r·J n/|r|⁵ dω
    count
  };
  /// Without prefactors while summing, with them in results.
  std::array<Vector3, count> of;
  double enclosure = 0.0;  ///< ∫ r·J n/|r|³ dω, with its prefactor D[1]

  LayersAt() { of.fill(Vector3::Zero()); }
};

/// Quadrature nodes in columns of equal stride.
struct NodeBlock {
  const double* data;
  Index stride;  ///< between columns
  Index n_nodes;
  const double* weight;  ///< [n_nodes], for dω

  [[nodiscard]] const double* column(int c) const { return data + c * stride; }
};

/// Turns plain densities f of the single layers into J f at the nodes.
/// @param nodes  columns of the given stride
void weigh_densities(const NodeColumns& columns, Index n_nodes, Index stride, double* nodes);

/// Adds the contribution of the block to a target at `offset` from the origin of the block's positions.
/// @param offset  target minus origin of the positions in the block, so that no digits cancel for near targets
/// Accuracy: rounding of the sums; vectorised, bit-identical for any number of threads
/// Source: paper Eqs. (6), (8); ∇D in the form ∫ ∇G × (n×∇_γ f) dA, as paper Eq. (24)
void add_layer_sums(const NodeColumns& columns, const NodeBlock& nodes, const Vector3& offset, LayersAt& sums);

/// Densities as spherical-harmonic coefficients of the order of the surface; an empty one costs nothing.
struct LayerDensities {
  Vector laplace_single;   ///< J f, or f where `plain`, [n_coefficients]
  Vector laplace_double;   ///< f, [n_coefficients]
  Matrix stokes_single;    ///< J f, or f where `plain`, [n_coefficients x 3]
  Matrix stokes_double;    ///< v, [n_coefficients x 3]
  bool gradients = false;  ///< of the Laplace layers
  bool plain = false;      ///< f is multiplied by J at the nodes, so that J f is not truncated to degree p
};

/// Coefficients of position and densities side by side, and the node columns that their synthesis gives.
struct LayerFields {
  Matrix coefficients;  ///< [n_coefficients x fields], the position first
  /// First field of each density, −1 if absent.
  int single = -1, double_layer = -1, stokes = -1, stokes_double = -1;
  NodeColumns columns;
};

/// @throws ShapeError if a density does not match the order of the position
/// @param position  coefficients of x, [n_coefficients x 3]
LayerFields make_layer_fields(const Matrix& position, const LayerDensities& densities);

}  // namespace vehd
