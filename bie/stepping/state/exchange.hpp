#pragma once

#include "bie/sphere/exchange.hpp"
#include "bie/stepping/state/model.hpp"
#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Which vesicles of a scene are images of others: equal ones, up to a few, that mirrors and half turns of the whole
/// or turns about z take to one another; of these groups the one that leaves least to compute. See Exchange for which
/// groups count.
/// Accuracy: what it finds changes no column of a history by more than rounding does
/// (tests/stepping/exchange_test.cpp)
Exchange find_exchange(const Model& model, const State& state);

/// What rides on an image of a membrane.
SurfaceFields image_of(const ImageOfFields& image, const SurfaceFields& fields);

/// The state with its images made anew from their originals: what rounding breaks of a symmetry an instability would
/// feed on. Degrees and quadrature are those of the originals as well.
State with_images(const Exchange& exchange, State state);

/// The degrees of all vesicles with those of the originals for the images.
std::vector<int> with_images(const Exchange& exchange, std::vector<int> orders);

}  // namespace vehd
