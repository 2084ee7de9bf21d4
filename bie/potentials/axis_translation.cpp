#include "bie/potentials/axis_translation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bie/sphere/small_product.hpp"

namespace vehd {

namespace {

/// Columns of all sources rotated together: two arrays of this width fill the second-level cache at degree 24.
constexpr Index kTogetherTurned = 32;

// Turnable order: per degree l the cosines of m = 0..l, then the sines of m = 1..l.
Index cosine_at(int l, int m) { return Index{l} * l + m; }
Index sine_at(int l, int m) { return Index{l} * l + l + m; }

double binomial(int n, int k) {
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value *= static_cast<double>(n - k + i) / i;
  return value;
}

}  // namespace

/// Workspace for several sources, whose columns follow one another.
struct AxisTranslation::Batch {
  Vector values, spare;
  Vector cosine, sine;  ///< of m times the polar angle, of each column
  /// Cosine and sine of m times the azimuth, for each source.
  Matrix azimuth_cosine, azimuth_sine;
  explicit Batch(int degree)
      : values(n_solid(degree) * kTogetherTurned),
        spare(std::max(n_solid(degree), Index{2} * (degree + 1)) * kTogetherTurned),
        cosine((degree + 1) * kTogetherTurned),
        sine(cosine.size()),
        azimuth_cosine(degree + 1, kTogetherTurned),
        azimuth_sine(degree + 1, kTogetherTurned) {}
};

AxisTranslation::AxisTranslation(int degree)
    : degree_(degree), quarter_(rotation_y(degree, 0.5 * std::numbers::pi)), scale_(n_solid(degree)) {
  solid_.resize(static_cast<std::size_t>(n_solid(degree)));
  sign_.assign(solid_.size(), 1.0);
  for (int m = 0; m <= degree; ++m) {
    RowMatrix& of_order = axis_.emplace_back(degree + 1 - m, degree + 1 - m);
    for (int n = m; n <= degree; ++n) {
      for (int l = m; l <= degree; ++l) {
        // (l + n)!/√((l − m)! (l + m)! (n − m)! (n + m)!)
        of_order(n - m, l - m) =
            ((n + m) % 2 == 0 ? 1.0 : -1.0) * std::sqrt(binomial(l + n, l - m) * binomial(l + n, l + m));
      }
    }
  }
  for (int l = 0; l <= degree; ++l) {
    // ±√((l − m)! (l + m)!), the sign that of R against the harmonics
    double factorials = 1.0;
    for (int i = 2; i <= l; ++i) factorials *= static_cast<double>(i);
    for (int m = 0; m <= l; ++m) {
      if (m > 0) factorials *= std::sqrt(static_cast<double>(l + m) / (l - m + 1));
      const double scale = (m % 2 == 0 ? 1.0 : -1.0) * (m == 0 ? 1.0 : std::numbers::sqrt2) * factorials;
      const Index c = cosine_at(l, m), s = sine_at(l, m);
      scale_[c] = scale;
      solid_[static_cast<std::size_t>(c)] = Index{l} * l + (m == 0 ? 0 : 2 * m - 1);
      if (m == 0) continue;
      scale_[s] = scale;
      solid_[static_cast<std::size_t>(s)] = Index{l} * l + 2 * m;
      sign_[static_cast<std::size_t>(s)] = -1.0;  // moments are conjugate
    }
  }
}

RowMatrix AxisTranslation::turnable(const Matrix& moments) const {
  RowMatrix result(scale_.size(), moments.cols());
  for (Index i = 0; i < scale_.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.row(i) = sign_[k] * scale_[i] * moments.row(solid_[k]);
  }
  return result;
}

void AxisTranslation::quarter_turn(int degree, bool back, const double* from, double* to) const {
  constexpr Index kWidth = kTogetherTurned;
  // Entries vanish if both orders and the degree add up to an odd number, those of sines if to an even one.
  const auto product = [&](const Matrix& table, Index row, Index first_after, Index first_before) {
    const Index n = table.rows();
    const Index after = (n - first_after + 1) / 2, before = (n - first_before + 1) / 2;
    if (after <= 0) return;
    const Index stride = n;
    const Factor factor = back ? Factor{table.data() + first_before + first_after * stride, 2 * stride, 2}
                               : Factor{table.data() + first_after + first_before * stride, 2, 2 * stride};
    small_product(after, std::max<Index>(before, 0), kWidth, factor, from + (row + first_before) * kWidth, 2 * kWidth,
                  to + (row + first_after) * kWidth, 2 * kWidth);
  };
  for (int l = 0; l <= degree; ++l) {
    for (const Index parity : {0, 1}) {
      const Index other = (l + parity) % 2;
      product(quarter_.cosine[static_cast<std::size_t>(l)], cosine_at(l, 0), parity, other);
      // m = 1 comes first.
      product(quarter_.sine[static_cast<std::size_t>(l)], sine_at(l, 1), parity, 1 - other);
    }
  }
}

void AxisTranslation::along_axis(int degree, double* values, double* spare) const {
  constexpr Index kWidth = kTogetherTurned;
  double* const result = spare + (degree + 1) * kWidth;
  for (int m = 0; m <= degree; ++m) {
    const Index n = degree + 1 - m;
    const RowMatrix& table = axis_[static_cast<std::size_t>(m)];
    for (const bool sine : {false, true}) {
      if (sine && m == 0) continue;
      const auto at = [&](Index i) {
        const int l = m + static_cast<int>(i);
        return values + (sine ? sine_at(l, m) : cosine_at(l, m)) * kWidth;
      };
      for (Index i = 0; i < n; ++i) std::copy_n(at(i), kWidth, spare + i * kWidth);
      small_product(n, n, kWidth, {table.data(), table.cols(), 1}, spare, kWidth, result, kWidth);
      for (Index i = 0; i < n; ++i) std::copy_n(result + i * kWidth, kWidth, at(i));
    }
  }
}

namespace {

/// Length of a translation, and the angles of the rotation that takes it to the axis.
struct TranslationAngles {
  double distance, cosine_polar, sine_polar, cosine_azimuth, sine_azimuth;

  explicit TranslationAngles(const Vector3& offset) : distance(offset.norm()) {
    const double across = std::hypot(offset.x(), offset.y());
    cosine_polar = offset.z() / distance;
    sine_polar = across / distance;
    // The azimuth minus a quarter turn.
    cosine_azimuth = across > 0.0 ? offset.y() / across : 0.0;
    sine_azimuth = across > 0.0 ? -offset.x() / across : -1.0;
  }
};

/// Cosines and sines of multiples of an angle.
struct Multiples {
  double cosine, sine, c = 1.0, s = 0.0;

  void next() {
    const double former = c;
    c = former * cosine - s * sine;
    s = s * cosine + former * sine;
  }
};

/// Rotates harmonics about z in place: all degrees, all columns.
void turn_about_axis(int degree, const Vector& cosine, const Vector& sine, bool back, double* values) {
  constexpr Index kWidth = kTogetherTurned;
  const double sign = back ? -1.0 : 1.0;
  for (int l = 1; l <= degree; ++l) {
    for (int m = 1; m <= l; ++m) {
      double* a = values + cosine_at(l, m) * kWidth;
      double* b = values + sine_at(l, m) * kWidth;
      const double *c = cosine.data() + m * kWidth, *s = sine.data() + m * kWidth;
#pragma omp simd
      for (Index i = 0; i < kWidth; ++i) {
        const double before = a[i], along = sign * s[i];
        a[i] = c[i] * before + along * b[i];
        b[i] = c[i] * b[i] - along * before;
      }
    }
  }
}

}  // namespace

template <int kColumns>
void AxisTranslation::add_local(std::span<const DistantMoments> sources, Batch& batch, RowMatrix& sum) const {
  constexpr Index kWidth = kTogetherTurned;
  using Few = Eigen::Array<double, kColumns, 1>;
  const auto few = [](double* at) { return Eigen::Map<Few>(at); };
  int degree = 0;
  for (const DistantMoments& source : sources) degree = std::max(degree, source.degree);
  if (static_cast<Index>(sources.size()) * kColumns < kWidth) batch.values.setZero();

  std::array<double, kTogetherTurned> inverse_distance;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const TranslationAngles way(sources[i].offset);
    inverse_distance[i] = 1.0 / way.distance;
    const auto first = static_cast<Index>(i) * kColumns;
    const auto to = [&](Index row) { return few(batch.values.data() + row * kWidth + first); };
    Multiples polar{way.cosine_polar, way.sine_polar}, azimuth{way.cosine_azimuth, way.sine_azimuth};
    double* cosines = batch.azimuth_cosine.col(static_cast<Index>(i)).data();
    double* sines = batch.azimuth_sine.col(static_cast<Index>(i)).data();
    for (int m = 0; m <= degree; ++m, polar.next(), azimuth.next()) {
      few(batch.cosine.data() + m * kWidth + first) = polar.c;
      few(batch.sine.data() + m * kWidth + first) = polar.s;
      cosines[m] = azimuth.c;
      sines[m] = azimuth.s;
    }
    const RowMatrix& moments = *sources[i].moments;
    const auto from = [&](Index row) -> Few {
      Few entry = Eigen::Map<const Few>(moments.row(row).data());
      // (x − c_b)·A = (x − c_a)·A + (c_a − c_b)·A.
      if constexpr (kColumns == 4) entry[3] -= entry.template head<3>().matrix().dot(sources[i].offset);
      return entry;
    };
    double power = 1.0;
    for (int l = 0; l <= degree; ++l, power *= inverse_distance[i]) {
      to(cosine_at(l, 0)) = power * from(cosine_at(l, 0));
      for (int m = 1; m <= l; ++m) {
        const Few a = power * from(cosine_at(l, m)), b = power * from(sine_at(l, m));
        to(cosine_at(l, m)) = cosines[m] * a + sines[m] * b;
        to(sine_at(l, m)) = cosines[m] * b - sines[m] * a;
      }
    }
  }

  double *values = batch.values.data(), *spare = batch.spare.data();
  quarter_turn(degree, true, values, spare);
  turn_about_axis(degree, batch.cosine, batch.sine, false, spare);
  quarter_turn(degree, false, spare, values);
  along_axis(degree, values, spare);
  quarter_turn(degree, true, values, spare);
  turn_about_axis(degree, batch.cosine, batch.sine, true, spare);
  quarter_turn(degree, false, spare, values);

  for (std::size_t i = 0; i < sources.size(); ++i) {
    const double* cosines = batch.azimuth_cosine.col(static_cast<Index>(i)).data();
    const double* sines = batch.azimuth_sine.col(static_cast<Index>(i)).data();
    const auto from = [&](Index row) -> Few { return few(values + row * kWidth + static_cast<Index>(i) * kColumns); };
    const auto to = [&](Index row) { return few(sum.row(row).data()); };
    double power = inverse_distance[i];
    for (int l = 0; l <= degree; ++l, power *= inverse_distance[i]) {
      to(cosine_at(l, 0)) += power * from(cosine_at(l, 0));
      for (int m = 1; m <= l; ++m) {
        const Few a = power * from(cosine_at(l, m)), b = power * from(sine_at(l, m));
        to(cosine_at(l, m)) += cosines[m] * a - sines[m] * b;
        to(sine_at(l, m)) += cosines[m] * b + sines[m] * a;
      }
    }
  }
}

Matrix AxisTranslation::local(std::span<const DistantMoments> sources, Index columns) const {
  RowMatrix sum = RowMatrix::Zero(scale_.size(), columns);
  Batch batch(degree_);
  const auto most = static_cast<std::size_t>(kTogetherTurned / columns);
  for (std::size_t first = 0; first < sources.size(); first += most) {
    const auto some = sources.subspan(first, std::min(most, sources.size() - first));
    columns == 4 ? add_local<4>(some, batch, sum) : add_local<1>(some, batch, sum);
  }
  Matrix result(sum.rows(), columns);
  for (Index i = 0; i < sum.rows(); ++i) {
    result.row(solid_[static_cast<std::size_t>(i)]) = scale_[i] * sum.row(i);
  }
  return result;
}

}  // namespace vehd
