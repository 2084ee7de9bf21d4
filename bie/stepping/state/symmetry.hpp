#pragma once

#include <array>
#include <string>
#include <type_traits>

#include "bie/physics/model.hpp"
#include "bie/sphere/exchange.hpp"
#include "bie/sphere/reflection.hpp"
#include "bie/sphere/symmetry.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/fields.hpp"
#include "bie/stepping/state/state.hpp"

/// Symmetries of a scene, and the fields that they leave. Deviations within 1e-12 of the size count as rounding.
namespace vehd {

/// Are field, flow and all effects their own images under every rotation about z?
bool is_invariant_under_rotations(const Model& model);

/// The fields of an image of a membrane, those of a state or those at one time.
template <typename Fields>
Fields image_of(const ImageOfFields& image, Fields fields) {
  for_each_field(
      [&](const FieldRow& row, auto& field) {
        if (row.kind == FieldKind::potential) field = image.potential(field);
        if (row.kind == FieldKind::scalar) field = image.scalar(field);
        if constexpr (std::is_same_v<decltype(field), Matrix&>) {
          if (row.kind == FieldKind::vector) field = image.vector(field);
        }
      },
      fields);
  return fields;
}

/// The state with its images made anew from their originals: what rounding breaks of a symmetry an instability would
/// feed on. Degrees and quadrature are those of the originals as well.
State with_images(const Exchange& exchange, State state);

/// The degrees of all vesicles with those of the originals for the images.
std::vector<int> with_images(const Exchange& exchange, std::vector<int> orders);

/// The symmetries that a scene as a whole has at its start and keeps: every vesicle is its own image, the flow is, and
/// so is the field up to its sign; and those under which equal vesicles change places, see Exchange. What `auto` finds.
/// Accuracy: what it finds changes no step by more than 1e-9 (tests/stepping/state/symmetry_test.cpp,
/// tests/stepping/state/fold_test.cpp), exchanges change no column of a history by more than rounding does
/// (tests/stepping/exchange_test.cpp)
Symmetry find_symmetry(const Model& model, const State& state);

/// In words: "axisymmetric about z, mirror z", "mirror y, half turn about y, inversion", "none"; of several vesicles
/// also "axisymmetric about z, vesicles exchanged by mirror z".
/// @param axes  their names; the third carries the poles
std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes = {"x", "y", "z"});

/// The part of the fields that is its own image.
SurfaceFields symmetric_part(const SymmetrySubspace& subspace, SurfaceFields fields);

}  // namespace vehd
