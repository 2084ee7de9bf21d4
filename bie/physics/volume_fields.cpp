#include "bie/physics/volume_fields.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bie/physics/wall_images.hpp"
#include "bie/potentials/pair_layers.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// The density, or zero coefficients if it is empty.
Matrix or_zero(const Matrix& density, const Matrix& position, Index components) {
  return density.size() > 0 ? density : Matrix::Zero(position.rows(), components);
}

}  // namespace

PotentialSamples potential_at(const Matrix& points, Side side, const Matrix& position, const PotentialSources& sources,
                              const OffSurfaceSettings& settings, Instruments& instruments) {
  LayerDensities densities;
  densities.laplace_single = or_zero(sources.weighted_charge, position, 1);
  densities.laplace_double = or_zero(sources.transmembrane_potential, position, 1);
  densities.gradients = true;
  const OffSurfaceLayers of_membrane(position, std::move(densities), settings);
  OffSurfaceValues layers = of_membrane.evaluate(points, side, instruments);
  require_resolved(layers, points);
  PotentialSamples samples;
  samples.potential = layers.laplace_single.values - layers.laplace_double.values - points * sources.field;
  samples.field = layers.laplace_double_gradient.values - layers.laplace_single_gradient.values;
  samples.field.rowwise() += sources.field.transpose();
  if (sources.wall && has_image(*sources.wall, PairLayer::laplace_single)) {
    const Wall& wall = *sources.wall;
    const OffSurfaceValues there = of_membrane.evaluate(mirrored(wall, points), Side::exterior, instruments);
    require_resolved(there, points);
    const Matrix potential = there.laplace_single.values - there.laplace_double.values;
    const Matrix field = there.laplace_double_gradient.values - there.laplace_single_gradient.values;
    samples.potential += mirrored_back(wall, PairLayer::laplace_single, potential);
    samples.field += mirrored_back(wall, PairLayer::laplace_single, field) * wall.mirror();
  }
  samples.side = std::move(layers.side);
  samples.distance = std::move(layers.distance);
  return samples;
}

namespace {

/// Contribution of the image in a wall to w.
Matrix flow_of_image(const Wall& wall, const Matrix& points, const Matrix& position, const VelocitySources& sources,
                     Instruments& instruments) {
  const double ratio = sources.viscosity_ratio;
  const PairSelection selection{.stokes_single = true, .stokes_double = ratio != 1.0};
  SharedTransforms transforms;
  const PairLayers layers(position, mirrored(wall, points), Matrix::Zero(points.rows(), 3),
                          selection_of_image(wall, selection), {}, transforms, instruments, {wall.point, wall.normal});
  const auto image = [&](PairLayer layer, const Matrix& density) {
    return mirrored_back(wall, layer, layers.apply(layer_of_image(wall, layer), density));
  };
  Matrix flow = image(PairLayer::stokes_single, or_zero(sources.weighted_force, position, 3)) / sources.viscosity;
  if (ratio != 1.0) flow += (1.0 - ratio) * image(PairLayer::stokes_double, sources.membrane_velocity);
  return flow;
}

}  // namespace

VelocitySamples velocity_at(const Matrix& points, const Matrix& position, const VelocitySources& sources,
                            const OffSurfaceSettings& settings, Instruments& instruments) {
  const double ratio = sources.viscosity_ratio;
  if (!(ratio > 0.0)) throw InputError(fmt::format("viscosity ratio of {}; accepted: > 0", ratio));
  LayerDensities densities;
  densities.stokes_single = or_zero(sources.weighted_force, position, 3);
  if (ratio != 1.0) densities.stokes_double = sources.membrane_velocity;
  // The exterior limit is w itself; only the interior one is divided by the ratio.
  OffSurfaceValues layers =
      OffSurfaceLayers(position, std::move(densities), settings).evaluate(points, Side::exterior, instruments);
  require_resolved(layers, points);
  VelocitySamples samples;
  samples.velocity = layers.stokes_single.values / sources.viscosity;
  for (Index i = 0; sources.background && i < points.rows(); ++i) {
    samples.velocity.row(i) += sources.background(points.row(i).transpose()).transpose();
  }
  if (sources.wall && has_image(*sources.wall, PairLayer::stokes_single)) {
    samples.velocity += flow_of_image(*sources.wall, points, position, sources, instruments);
  }
  if (ratio != 1.0) {
    samples.velocity += (1.0 - ratio) * layers.stokes_double.values;
    for (Index i = 0; i < points.rows(); ++i) {
      if (layers.side[i] == Side::interior) samples.velocity.row(i) /= ratio;
    }
  }
  samples.side = std::move(layers.side);
  samples.distance = std::move(layers.distance);
  return samples;
}

}  // namespace vehd
