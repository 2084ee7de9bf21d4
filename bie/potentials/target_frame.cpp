#include "bie/potentials/target_frame.hpp"

#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Multiplies coefficients by the block of one degree or its transpose. @param before  [m x fields filled up to lanes]
void rotate(const Matrix& block, bool back, const RowMatrix& before, RowMatrix& after) {
  after.resize(before.rows(), before.cols());
  const Index n = block.rows();
  small_product(n, n, before.cols(), {block.data(), back ? n : 1, back ? 1 : n}, before.data(), before.cols(),
                after.data(), before.cols());
}

}  // namespace

TargetFrame::TargetFrame(const LayerFields& fields, double theta, double phi)
    : fields_(fields),
      order_(order_of(fields.coefficients.rows())),
      n_fields_(fields.coefficients.cols()),
      azimuth_cosine_(order_ + 1),
      azimuth_sine_(order_ + 1),
      rotation_(rotation_y(order_, theta)),
      pole_(Eigen::RowVectorXd::Zero(n_fields_)) {
  for (int m = 0; m <= order_; ++m) {
    azimuth_cosine_[m] = std::cos(m * phi);
    azimuth_sine_[m] = std::sin(m * phi);
    rotated_.emplace_back(Matrix::Zero(order_ + 1 - m, 2 * n_fields_));
  }
  RowMatrix cosine, sine, cosine_after, sine_after;
  const Index width = filled_up(n_fields_);
  for (int n = 0; n <= order_; ++n) {
    cosine.setZero(n + 1, width);
    sine.setZero(n, width);
    for (int m = 0; m <= n; ++m) {
      const double c = azimuth_cosine_[m];
      const double s = azimuth_sine_[m];
      const auto a = fields.coefficients.row(coefficient_index(n, m));
      const auto b = fields.coefficients.row(coefficient_index(n, -m));
      if (m == 0) {
        cosine.row(0).head(n_fields_) = a;
        continue;
      }
      cosine.row(m).head(n_fields_) = c * a + s * b;
      sine.row(m - 1).head(n_fields_) = c * b - s * a;
    }
    rotate(rotation_.cosine[n], false, cosine, cosine_after);
    rotate(rotation_.sine[n], false, sine, sine_after);
    for (int m = 0; m <= n; ++m) {
      rotated_[m].row(n - m).head(n_fields_) = cosine_after.row(m).head(n_fields_);
      if (m > 0) rotated_[m].row(n - m).tail(n_fields_) = sine_after.row(m - 1).head(n_fields_);
    }
    pole_ += std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi)) * cosine_after.row(0).head(n_fields_);
  }
}

RowMatrix TargetFrame::amplitudes(const GradedRule& rule) const {
  const NodeColumns& columns = fields_.columns;
  const Index n_theta = rule.theta.size();
  RowMatrix result = RowMatrix::Zero(rule.azimuths.n_modes(), filled_up(columns.count * n_theta));
  RowMatrix product(2 * n_fields_, 3 * n_theta);  // kinds of one field, one after another
  const auto put = [&](int m, int column, const auto& cosine, const auto& sine) {
    result.row(m).segment(column * n_theta, n_theta) = cosine;
    if (m > 0) result.row(order_ + m).segment(column * n_theta, n_theta) = sine;
  };
  for (int m = 0; m <= order_; ++m) {
    const Index n_degrees = order_ + 1 - m;
    small_product(2 * n_fields_, n_degrees, 3 * n_theta, {rotated_[m].data(), n_degrees, 1}, rule.synthesis[m].data(),
                  3 * n_theta, product.data(), 3 * n_theta);
    const auto part = [&](Index kind, Index field) { return product.row(field).segment(kind * n_theta, n_theta); };
    const auto put_value = [&](int column, Index field) { put(m, column, part(0, field), part(0, n_fields_ + field)); };
    const auto put_tangents = [&](int column_1, int column_2, Index field) {
      put(m, column_1, part(1, field), part(1, n_fields_ + field));
      put(m, column_2, part(2, n_fields_ + field), -part(2, field));
    };
    for (int i = 0; i < 3; ++i) {
      put_value(columns.position + i, i);
      put_tangents(columns.tangent_1 + i, columns.tangent_2 + i, i);
    }
    if (columns.single >= 0) put_value(columns.single, fields_.single);
    if (columns.double_layer >= 0) put_value(columns.double_layer, fields_.double_layer);
    if (columns.double_1 >= 0) put_tangents(columns.double_1, columns.double_2, fields_.double_layer);
    for (int i = 0; i < 3 && columns.stokes >= 0; ++i) put_value(columns.stokes + i, fields_.stokes + i);
    for (int i = 0; i < 3 && columns.stokes_double >= 0; ++i) {
      put_value(columns.stokes_double + i, fields_.stokes_double + i);
    }
  }
  // The tables hold differences from the pole.
  const auto add_pole = [&](int column, Index field) {
    result.row(0).segment(column * n_theta, n_theta).array() += pole_[field];
  };
  if (columns.single >= 0) add_pole(columns.single, fields_.single);
  for (int i = 0; i < 3 && columns.stokes >= 0; ++i) add_pole(columns.stokes + i, fields_.stokes + i);
  return result;
}

RowMatrix TargetFrame::nodes(const GradedRule& rule) const {
  RowMatrix values = rule.azimuths.values(amplitudes(rule));
  const Index n_theta = rule.theta.size();
  for (Index k = 0; k < rule.n_phi; ++k) weigh_densities(fields_.columns, n_theta, n_theta, values.row(k).data());
  return values;
}

RowMatrix TargetFrame::rotated_back(const std::vector<RowMatrix>& rotated) const {
  const Index n_columns = rotated.front().rows() / 2;
  RowMatrix result(n_columns, fields_.coefficients.rows());
  RowMatrix cosine, sine, cosine_before, sine_before;
  const Index width = filled_up(n_columns);
  for (int n = 0; n <= order_; ++n) {
    cosine.setZero(n + 1, width);
    sine.setZero(n, width);
    for (int m = 0; m <= n; ++m) {
      cosine.row(m).head(n_columns) = rotated[m].col(n - m).head(n_columns).transpose();
      if (m > 0) sine.row(m - 1).head(n_columns) = rotated[m].col(n - m).tail(n_columns).transpose();
    }
    rotate(rotation_.cosine[n], true, cosine, cosine_before);
    rotate(rotation_.sine[n], true, sine, sine_before);
    result.col(coefficient_index(n, 0)) = cosine_before.row(0).head(n_columns).transpose();
    for (int m = 1; m <= n; ++m) {
      const double c = azimuth_cosine_[m];
      const double s = azimuth_sine_[m];
      const auto before_cosine = cosine_before.row(m).head(n_columns);
      const auto before_sine = sine_before.row(m - 1).head(n_columns);
      result.col(coefficient_index(n, m)) = (c * before_cosine - s * before_sine).transpose();
      result.col(coefficient_index(n, -m)) = (s * before_cosine + c * before_sine).transpose();
    }
  }
  return result;
}

LayersAt TargetFrame::integrate(const GradedRule& rule, const Vector3& offset) const {
  const Index n_theta = rule.theta.size();
  const RowMatrix values = nodes(rule);
  LayersAt sums;
  for (int k = 0; k < rule.n_phi; ++k) {
    add_layer_sums(fields_.columns, {values.row(k).data(), n_theta, n_theta, rule.weight.data()}, offset, sums);
  }
  return sums;
}

}  // namespace vehd
