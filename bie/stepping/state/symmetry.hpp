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

/// Symmetries of a scene and symmetric parts of its fields. Deviations within 1e-12 of the size count as rounding.
namespace vehd {

/// Are field, flow and all effects invariant under every rotation about z?
bool is_invariant_under_rotations(const Model& model);

/// The fields of the image of a membrane, of a state or of one time, from those of the original.
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

/// The state with its images recomputed from their originals, because instabilities would amplify rounding that breaks
/// the symmetry. Images get degree and quadrature of their originals.
State with_images(const Exchange& exchange, State state);

/// The degrees of all vesicles, with those of the originals in place of those of images.
std::vector<int> with_images(const Exchange& exchange, std::vector<int> orders);

/// The symmetries of a scene at its start, which it keeps: those under which every vesicle, the flow and, up to its
/// sign, the field are invariant; and those that exchange equal vesicles, see Exchange. Used for `auto`.
/// Accuracy: the symmetries found change no step by more than 1e-9 (tests/stepping/state/symmetry_test.cpp,
/// tests/stepping/state/fold_test.cpp), exchanges change no column of a history by more than rounding
/// (tests/stepping/exchange_test.cpp)
Symmetry find_symmetry(const Model& model, const State& state);

/// In words: "axisymmetric about z, mirror z", "mirror y, half turn about y, inversion", "none"; of several vesicles
/// also "axisymmetric about z, vesicles exchanged by mirror z".
/// @param axes  their names; the third carries the poles
std::string symmetry_text(const Symmetry& symmetry, const std::array<std::string, 3>& axes = {"x", "y", "z"});

/// The part of the fields that is invariant under the symmetry.
SurfaceFields symmetric_part(const SymmetrySubspace& subspace, SurfaceFields fields);

}  // namespace vehd
