#include "meshes/lattice.hpp"

#include <algorithm>
#include <map>

#include "meshes/breaks.hpp"
#include "meshes/gauss_rule.hpp"

namespace vehd::meshes {
namespace {

/// Number of the interval between breaks that contains a value; the nearest one for values beyond the ends.
int interval_of(const std::vector<double>& breaks, double value) {
  const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, value);
  return static_cast<int>(next - breaks.begin()) - 1;
}

/// Builds the cells; integer keys identify the nodes, so that neighbours share them exactly.
class Builder {
 public:
  Builder(Region region, int degree, const std::vector<double>& across, const std::vector<double>& outwards,
          const std::vector<double>& line)
      : region_(region), degree_(degree), across_(across), outwards_(outwards), line_(line) {}

  void add_cell(const Block& block, const std::array<int, 3>& first_node) {
    Lattice::Cell cell;
    std::array<int, 3> at{};
    for (at[2] = first_node[2]; at[2] <= first_node[2] + degree_; ++at[2]) {
      for (at[1] = first_node[1]; at[1] <= first_node[1] + degree_; ++at[1]) {
        for (at[0] = first_node[0]; at[0] <= first_node[0] + degree_; ++at[0]) cell.nodes.push_back(node(block, at));
      }
    }
    cells.push_back(std::move(cell));
  }

  std::vector<Lattice::Node> nodes;
  std::vector<Lattice::Cell> cells;

 private:
  [[nodiscard]] double coordinate(const std::vector<double>& breaks, int index) const {
    const int cell = std::min(index / degree_, static_cast<int>(breaks.size()) - 2);
    return breaks[cell] + (breaks[cell + 1] - breaks[cell]) * line_[index - cell * degree_];
  }

  int node(const Block& block, const std::array<int, 3>& at) {
    const bool core = block.layer == Block::Layer::core;
    const int last = degree_ * (static_cast<int>(across_.size()) - 1);
    std::array<int, 4> key{at[0], at[1], at[2], 0};
    if (!core) {
      key[block.axis] = block.sign < 0.0 ? 0 : last;
      key[(block.axis + 1) % 3] = at[0];
      key[(block.axis + 2) % 3] = at[1];
      key[3] = at[2];
    }
    // A node inside the core must differ from the node of the innermost layer with the same integers.
    const bool on_core = std::any_of(key.begin(), key.end() - 1, [&](int k) { return k == 0 || k == last; });
    if (core && !on_core) key[3] = -1;
    const auto [known, added] = number_.try_emplace(key, static_cast<int>(nodes.size()));
    if (!added) return known->second;
    const int outermost = degree_ * (static_cast<int>(outwards_.size()) - 1);
    Lattice::Boundary boundary = Lattice::Boundary::none;
    if (key[3] == outermost)
      boundary = region_ == Region::inside ? Lattice::Boundary::membrane : Lattice::Boundary::outer;
    if (key[3] == 0 && region_ == Region::outside) boundary = Lattice::Boundary::membrane;
    const Point place(coordinate(across_, at[0]), coordinate(across_, at[1]),
                      coordinate(core ? across_ : outwards_, at[2]));
    nodes.push_back({{block, place}, boundary});
    return known->second;
  }

  Region region_;
  int degree_;
  const std::vector<double>&across_, &outwards_, &line_;
  std::map<std::array<int, 4>, int> number_;
};

}  // namespace

Lattice::Lattice(Region region, int cells_per_edge, int degree, std::vector<double> breaks)
    : region_(region), cells_per_edge_(cells_per_edge), degree_(degree), breaks_(std::move(breaks)) {
  for (const double x : lobatto_rule(degree + 1).node) line_.push_back(0.5 + 0.5 * x);
  const std::vector<double> across = even_breaks(cells_per_edge);
  Builder builder(region, degree, across, breaks_, line_);
  const auto add_block = [&](const Block& block, int layers) {
    for (int k = 0; k < layers; ++k) {
      for (int j = 0; j < cells_per_edge; ++j) {
        for (int i = 0; i < cells_per_edge; ++i) builder.add_cell(block, {i * degree, j * degree, k * degree});
      }
    }
  };
  if (region == Region::inside) add_block({Block::Layer::core, 0, 1.0}, cells_per_edge);
  const Block::Layer layer = region == Region::inside ? Block::Layer::blend : Block::Layer::shell;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) add_block({layer, axis, sign}, static_cast<int>(breaks_.size()) - 1);
  }
  nodes_ = std::move(builder.nodes);
  cells_ = std::move(builder.cells);
}

Lattice::Located Lattice::locate(const BlockPlace& place) const {
  const bool core = place.block.layer == Block::Layer::core;
  const std::vector<double> across = even_breaks(cells_per_edge_);
  std::array<int, 3> index{};
  Located result;
  for (int d = 0; d < 3; ++d) {
    const std::vector<double>& breaks = d == 2 && !core ? breaks_ : across;
    index[d] = interval_of(breaks, place.at[d]);
    result.scale[d] = 1.0 / (breaks[index[d] + 1] - breaks[index[d]]);
    result.unit[d] = (place.at[d] - breaks[index[d]]) * result.scale[d];
  }
  const int n = cells_per_edge_;
  int first = 0;
  if (!core) {
    const int per_block = n * n * (static_cast<int>(breaks_.size()) - 1);
    first = (region_ == Region::inside ? n * n * n : 0) + per_block * (2 * place.block.axis + (place.block.sign > 0.0));
  }
  result.cell = &cells_[first + index[0] + n * (index[1] + n * index[2])];
  return result;
}

Lattice::Sample Lattice::sample(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const {
  const Located located = locate(place);
  const NodalPolynomials polynomials(line_, {located.unit.x(), located.unit.y(), located.unit.z()});
  const Eigen::MatrixXd& v = polynomials.value;
  const Eigen::MatrixXd& s = polynomials.slope;
  Sample result{Point::Zero(), Matrix3::Zero()};
  std::size_t node = 0;
  for (int k = 0; k <= degree_; ++k) {
    for (int j = 0; j <= degree_; ++j) {
      for (int i = 0; i <= degree_; ++i, ++node) {
        const Point x = nodal.col(located.cell->nodes[node]);
        result.value += v(0, i) * v(1, j) * v(2, k) * x;
        result.derivative +=
            x *
            Point(s(0, i) * v(1, j) * v(2, k), v(0, i) * s(1, j) * v(2, k), v(0, i) * v(1, j) * s(2, k)).transpose();
      }
    }
  }
  result.derivative = result.derivative * located.scale.asDiagonal();
  return result;
}

Point Lattice::value(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const {
  return sample(nodal, place).value;
}

}  // namespace vehd::meshes
