#pragma once

#include <type_traits>

#include "bie/physics/model.hpp"
#include "bie/sphere/exchange.hpp"
#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Which vesicles of a scene are images of others: equal ones, up to a few, that mirrors and half turns of the whole
/// or turns about z take to one another; of these groups the one that leaves least to compute. See Exchange for which
/// groups count.
/// Accuracy: what it finds changes no column of a history by more than rounding does
/// (tests/stepping/exchange_test.cpp)
Exchange find_exchange(const Model& model, const State& state);

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

}  // namespace vehd
