#pragma once

#include <array>

#include "bie/support/types.hpp"

namespace vehd {

/// Where each field stands among the columns of a block of quadrature nodes: the position y, its tangents y_1, y_2 in
/// the frame of the unit sphere, and what the wanted layers need of their densities. −1: absent.
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

/// The layers at one target. Scalar ones are first components.
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
  /// Without prefactors in sums, with them elsewhere.
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

/// Adds the block's share for the target at `offset` from the origin of the block's positions.
/// @param offset  target minus origin of the positions in the block, so that near targets lose no digits
/// Accuracy: rounding of the sums; vectorised, equal bits for any count of threads
/// Source: paper Eqs. (6), (8); ∇D in the form ∫ ∇G × (n×∇_γ f) dA, as paper Eq. (24)
void add_layer_sums(const NodeColumns& columns, const NodeBlock& nodes, const Vector3& offset, LayersAt& sums);

}  // namespace vehd
