#include "meshes/relaxed_map.hpp"

namespace vehd::meshes {
namespace {

Region region_of(const Block& block) { return block.layer == Block::Layer::shell ? Region::outside : Region::inside; }

/// The point with another third coordinate.
BlockPlace at_third(BlockPlace place, double t) {
  place.at.z() = t;
  return place;
}

}  // namespace

RelaxedMap::RelaxedMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius,
                       std::shared_ptr<const RelaxedBlocks> blocks)
    : BlockMap(shape, axes, outer_radius), blocks_(std::move(blocks)) {}

RelaxedMap::Place RelaxedMap::place_of(const Block& block, const CubePoint& point) const {
  const Point across(point.v[(block.axis + 1) % 3], point.v[(block.axis + 2) % 3], 0.0);
  if (block.layer == Block::Layer::blend) {
    const double slope = 1.0 / (kMembrane - kCore);
    return {at_third({block, across}, (point.s - kCore) * slope), slope};
  }
  // Linear in the radius from that of the shape outwards; 1 where the relaxed layers end.
  const double first_radius = blocks_->end_radius() - blocks_->thickness();
  const double slope = (outer_radius() - first_radius) / blocks_->thickness() / (kOuter - kMembrane);
  return {at_third({block, across}, (point.s - kMembrane) * slope), slope};
}

RelaxedMap::Share RelaxedMap::share_of_membrane(Region region, double t) const {
  const std::vector<double>& breaks = blocks_->lattice(region).breaks();
  const double begin = region == Region::inside ? breaks[breaks.size() - 2] : breaks[1];
  const double end = region == Region::inside ? 1.0 : 0.0;
  const double slope = 1.0 / (end - begin);
  const double value = (t - begin) * slope;
  return value > 0.0 ? Share{value, slope} : Share{0.0, 0.0};
}

RelaxedMap::Share RelaxedMap::share_of_end(Region region, double t) const {
  if (region == Region::inside) return {0.0, 0.0};
  const std::vector<double>& breaks = blocks_->lattice(region).breaks();
  const double slope = 1.0 / (1.0 - breaks[breaks.size() - 2]);
  const double value = 1.0 - (1.0 - t) * slope;
  return value > 0.0 ? Share{value, slope} : Share{0.0, 0.0};
}

Point RelaxedMap::in_core(const Point& reference) const {
  const BlockPlace place{{Block::Layer::core, 0, 1.0}, reference / kCore};
  return centre() + blocks_->lattice(Region::inside).value(blocks_->nodes(Region::inside), place);
}

Point RelaxedMap::around_core(const Block& block, const Point& reference, const Point& on_membrane) const {
  const CubePoint point = cube_point(block, reference);
  const auto [place, slope] = place_of(block, point);
  const double t = place.at.z();
  const Point towards = block_to_space() * point.g.normalized();
  if (t > 1.0 && block.layer == Block::Layer::shell) {
    return centre() + (blocks_->end_radius() + (t - 1.0) * blocks_->thickness()) * towards;
  }
  const Region region = region_of(block);
  const Lattice& lattice = blocks_->lattice(region);
  const Eigen::Matrix3Xd& nodes = blocks_->nodes(region);
  Point result = centre() + lattice.value(nodes, place);
  const double on_edge = region == Region::inside ? 1.0 : 0.0;
  if (const Share share = share_of_membrane(region, t); share.value > 0.0) {
    result += share.value * (on_membrane - centre() - lattice.value(nodes, at_third(place, on_edge)));
  }
  if (const Share share = share_of_end(region, t); share.value > 0.0) {
    result += share.value * (blocks_->end_radius() * towards - lattice.value(nodes, at_third(place, 1.0)));
  }
  return result;
}

Matrix3 RelaxedMap::derivative(const Block& block, const Point& reference) const {
  if (block.layer == Block::Layer::core) {
    const BlockPlace place{{Block::Layer::core, 0, 1.0}, reference / kCore};
    return blocks_->lattice(Region::inside).sample(blocks_->nodes(Region::inside), place).derivative / kCore;
  }
  const CubePoint point = cube_point(block, reference);
  const CubeSlopes slopes = cube_slopes(block, point);
  // A named variable: clang 14 cannot capture structured bindings.
  const Place sloped = place_of(block, point);
  const BlockPlace& place = sloped.place;
  const double slope = sloped.slope, t = place.at.z();
  const Point unit = point.g.normalized();
  if (t > 1.0 && block.layer == Block::Layer::shell) {
    const double radius = blocks_->end_radius() + (t - 1.0) * blocks_->thickness();
    return block_to_space() * (radius * slopes.unit + slope * blocks_->thickness() * unit * slopes.s.transpose());
  }
  const Region region = region_of(block);
  const Lattice& lattice = blocks_->lattice(region);
  const Eigen::Matrix3Xd& nodes = blocks_->nodes(region);
  Matrix3 place_slope;  // derivatives of the block coordinates with respect to X
  place_slope << slopes.v.row((block.axis + 1) % 3), slopes.v.row((block.axis + 2) % 3), slope * slopes.s.transpose();
  Matrix3 across = place_slope;
  across.row(2).setZero();
  Matrix3 result = lattice.sample(nodes, place).derivative * place_slope;
  const auto add = [&](const Share& share, double on_edge, const Point& target, const Matrix3& target_slope) {
    if (!(share.value > 0.0)) return;
    const Lattice::Sample sample = lattice.sample(nodes, at_third(place, on_edge));
    result += share.value * (target_slope - sample.derivative * across) +
              (target - sample.value) * share.slope * place_slope.row(2);
  };
  const Point r = block_to_direction() * unit;
  add(share_of_membrane(region, t), region == Region::inside ? 1.0 : 0.0, shape().position(r) - centre(),
      shape().tangent_map(r) * block_to_direction() * slopes.unit);
  add(share_of_end(region, t), 1.0, blocks_->end_radius() * block_to_space() * unit,
      blocks_->end_radius() * block_to_space() * slopes.unit);
  return result;
}

}  // namespace vehd::meshes
