#include "meshes/harmonic_series.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace vehd::meshes {
namespace {

using Eigen::Index;

/// Number of points evaluated together: one or two vector registers.
constexpr int kLanes = 8;

int degree_of(Index n_coefficients) {
  const int side = static_cast<int>(std::lround(std::sqrt(double(n_coefficients))));
  if (side < 1 || Index{side} * side != n_coefficients) {
    throw std::invalid_argument(
        fmt::format("{} harmonic coefficients: the number must be a square (degree + 1)²", n_coefficients));
  }
  return side - 1;
}

/// Recurrences are stored order after order: m = 0 with n = 0 … degree, m = 1 with n = 1 … degree, …
Index offset_of_order(int degree, int m) { return Index{m} * (degree + 1) - Index{m} * (m - 1) / 2; }

}  // namespace

HarmonicSeries::HarmonicSeries(const Eigen::MatrixXd& coefficients)
    : degree_(degree_of(coefficients.rows())), coefficients_(coefficients.transpose()) {
  sectoral_.resize(degree_ + 1);
  sectoral_[0] = std::sqrt(0.25 / std::numbers::pi);
  for (int m = 1; m <= degree_; ++m) {
    // Real harmonics with m > 0 have a factor √2, introduced at m = 1.
    sectoral_[m] = sectoral_[m - 1] * std::sqrt((2.0 * m + 1.0) / (2.0 * m)) * (m == 1 ? std::numbers::sqrt2 : 1.0);
  }
  for (int m = 0; m <= degree_; ++m) {
    for (int n = m; n <= degree_; ++n) {
      const double nn = n;
      const double mm = m;
      const double up = n == m ? 0.0 : std::sqrt((2 * nn - 1) * (2 * nn + 1) / ((nn - mm) * (nn + mm)));
      const double down =
          n < m + 2 ? 0.0
                    : std::sqrt((2 * nn + 1) * (nn + mm - 1) * (nn - mm - 1) / ((2 * nn - 3) * (nn - mm) * (nn + mm)));
      up_.push_back(up);
      down_.push_back(down);
      // d/dz of the m-th derivative of P_n is the (m+1)-th; Q_n^1 has a factor √2 that Q_n^0 does not have.
      slope_.push_back(std::sqrt((nn - mm) * (nn + mm + 1)) / (m == 0 ? std::numbers::sqrt2 : 1.0));
    }
  }
}

Eigen::VectorXd HarmonicSeries::value(const Point& direction) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(n_columns());
  const double z = direction.z();
  double re = 1.0;
  double im = 0.0;
  for (int m = 0; m <= degree_; ++m) {
    const Index start = offset_of_order(degree_, m) - m;
    double before = 0.0;
    double q = sectoral_[m];
    for (int n = m; n <= degree_; ++n) {
      if (n > m) {
        const double next = up_[start + n] * z * q - down_[start + n] * before;
        before = q;
        q = next;
      }
      const Index centre = Index{n} * n + n;
      for (Index c = 0; c < n_columns(); ++c) {
        double sum = coefficients_(c, centre + m) * re;
        if (m > 0) sum += coefficients_(c, centre - m) * im;
        result[c] += q * sum;
      }
    }
    const double next_re = re * direction.x() - im * direction.y();
    im = re * direction.y() + im * direction.x();
    re = next_re;
  }
  return result;
}

Eigen::MatrixXd HarmonicSeries::values(const Eigen::Matrix3Xd& directions) const {
  using Lanes = Eigen::Array<double, kLanes, 1>;
  Eigen::MatrixXd result(n_columns(), directions.cols());
  std::vector<Lanes> cosine(n_columns());
  std::vector<Lanes> sine(n_columns());
  std::vector<Lanes> sum(n_columns());
  for (Index first = 0; first < directions.cols(); first += kLanes) {
    const Index count = std::min<Index>(kLanes, directions.cols() - first);
    Lanes x = Lanes::Zero();
    Lanes y = Lanes::Zero();
    Lanes z = Lanes::Zero();
    for (Index lane = 0; lane < count; ++lane) {
      x[lane] = directions(0, first + lane);
      y[lane] = directions(1, first + lane);
      z[lane] = directions(2, first + lane);
    }
    for (Lanes& s : sum) s.setZero();
    Lanes re = Lanes::Ones();
    Lanes im = Lanes::Zero();
    for (int m = 0; m <= degree_; ++m) {
      const Index start = offset_of_order(degree_, m) - m;
      Lanes before = Lanes::Zero();
      Lanes q = Lanes::Constant(sectoral_[m]);
      for (Index c = 0; c < n_columns(); ++c) {
        cosine[c].setZero();
        sine[c].setZero();
      }
      for (int n = m; n <= degree_; ++n) {
        if (n > m) {
          const Lanes next = up_[start + n] * z * q - down_[start + n] * before;
          before = q;
          q = next;
        }
        const Index centre = Index{n} * n + n;
        for (Index c = 0; c < n_columns(); ++c) {
          cosine[c] += coefficients_(c, centre + m) * q;
          if (m > 0) sine[c] += coefficients_(c, centre - m) * q;
        }
      }
      for (Index c = 0; c < n_columns(); ++c) sum[c] += cosine[c] * re + sine[c] * im;
      const Lanes next_re = re * x - im * y;
      im = re * y + im * x;
      re = next_re;
    }
    for (Index lane = 0; lane < count; ++lane) {
      for (Index c = 0; c < n_columns(); ++c) result(c, first + lane) = sum[c][lane];
    }
  }
  return result;
}

void HarmonicSeries::value_and_gradient(const Point& direction, Eigen::VectorXd& value,
                                        Eigen::MatrixXd& gradient) const {
  value.setZero(n_columns());
  gradient.setZero(n_columns(), 3);
  const double z = direction.z();
  // Q_n^{m+1} gives the slope of Q_n^m: orders run downwards, and the order above is kept.
  std::vector<double> q(degree_ + 1, 0.0);
  std::vector<double> above(degree_ + 1, 0.0);
  std::vector<double> re(degree_ + 1, 1.0);
  std::vector<double> im(degree_ + 1, 0.0);
  for (int m = 1; m <= degree_; ++m) {
    re[m] = re[m - 1] * direction.x() - im[m - 1] * direction.y();
    im[m] = re[m - 1] * direction.y() + im[m - 1] * direction.x();
  }
  for (int m = degree_; m >= 0; --m) {
    const Index start = offset_of_order(degree_, m) - m;
    q[m] = sectoral_[m];
    for (int n = m + 1; n <= degree_; ++n) {
      q[n] = up_[start + n] * z * q[n - 1] - (n > m + 1 ? down_[start + n] * q[n - 2] : 0.0);
    }
    const double re_slope = m > 0 ? m * re[m - 1] : 0.0;  // ∂/∂x of Re (x + iy)^m, and ∂/∂y of Im
    const double im_slope = m > 0 ? m * im[m - 1] : 0.0;  // ∂/∂x of Im, and −∂/∂y of Re
    for (int n = m; n <= degree_; ++n) {
      const Index centre = Index{n} * n + n;
      const double q_slope = n > m ? slope_[start + n] * above[n] : 0.0;
      for (Index c = 0; c < n_columns(); ++c) {
        const double a = coefficients_(c, centre + m);
        const double b = m > 0 ? coefficients_(c, centre - m) : 0.0;
        const double azimuthal = a * re[m] + b * im[m];
        value[c] += q[n] * azimuthal;
        gradient(c, 0) += q[n] * (a * re_slope + b * im_slope);
        gradient(c, 1) += q[n] * (b * re_slope - a * im_slope);
        gradient(c, 2) += q_slope * azimuthal;
      }
    }
    std::swap(q, above);
  }
  // The polynomials extend to all of space; only the tangential part of their gradient is the surface gradient.
  gradient -= (gradient * direction) * direction.transpose();
}

Eigen::MatrixXd HarmonicSeries::gradient(const Point& direction) const {
  Eigen::VectorXd value;
  Eigen::MatrixXd result;
  value_and_gradient(direction, value, result);
  return result;
}

Point direction_of(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace vehd::meshes
