#include "bie/sphere/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

double angle_of(const Isometry& map) { return 2.0 * std::numbers::pi * map.turn / map.fold; }

}  // namespace

Matrix3 Isometry::matrix() const {
  const Matrix3 mirrors = Vector3(reflection.x, reflection.y, reflection.z).asDiagonal();
  if (turn == 0) return mirrors;
  return Eigen::AngleAxisd(angle_of(*this), Vector3::UnitZ()).toRotationMatrix() * mirrors;
}

Matrix ImageOfFields::scalar(const Matrix& field) const {
  Matrix result = field;
  if (field.size() == 0) return result;
  const double angle = angle_of(map);
  for (int n = 0; n <= order_of(field.rows()); ++n) {
    for (int m = -n; m <= n; ++m) result.row(coefficient_index(n, m)) *= map.reflection.parity(n, m);
    if (map.turn == 0) continue;
    for (int m = 1; m <= n; ++m) {
      // cos m(φ − α) and sin m(φ − α) in terms of cos mφ and sin mφ.
      auto cosine = result.row(coefficient_index(n, m)), sine = result.row(coefficient_index(n, -m));
      const Eigen::RowVectorXd before = cosine;
      cosine = std::cos(m * angle) * before - std::sin(m * angle) * sine;
      sine = std::sin(m * angle) * before + std::cos(m * angle) * sine.eval();
    }
  }
  return result;
}

Matrix ImageOfFields::potential(const Matrix& field) const {
  return static_cast<double>(potential_sign) * scalar(field);
}

Matrix ImageOfFields::vector(const Matrix& field) const {
  if (field.size() == 0) return field;
  return scalar(field) * map.matrix().transpose();
}

Exchange::Exchange(std::vector<Map> maps) : maps_(std::move(maps)) {
  const std::size_t n = maps_.front().places.size();
  bodies_.assign(n, 0);
  for (std::size_t body = 0; body < n; ++body) originals_.push_back(body);
  for (std::size_t body = 0; body < n; ++body) {
    if (originals_[body] != body) continue;
    for (std::size_t g = 1; g < maps_.size(); ++g) {
      const std::size_t image = maps_[g].places[body];
      if (image == body) continue;
      originals_[image] = body;
      bodies_[image] = g;
    }
  }
}

std::vector<Isometry> Exchange::maps() const {
  std::vector<Isometry> result;
  for (std::size_t g = 1; g < maps_.size(); ++g) result.push_back(maps_[g].of_fields.map);
  return result;
}

std::size_t Exchange::n_originals(std::size_t n) const {
  std::size_t count = 0;
  for (std::size_t body = 0; body < n; ++body) count += is_image(body) ? 0 : 1;
  return count;
}

std::size_t Exchange::preimage(std::size_t image, std::size_t body) const {
  if (!any()) return body;
  const std::vector<std::size_t>& places = map_of(image).places;
  return static_cast<std::size_t>(std::ranges::find(places, body) - places.begin());
}

}  // namespace vehd
