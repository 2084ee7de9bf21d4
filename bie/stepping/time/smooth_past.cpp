#include "bie/stepping/time/smooth_past.hpp"

#include <utility>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

namespace {

/// One degree of x, or of a scalar, at the times of a past.
class PastOfDegree {
 public:
  /// @param first, count  its columns among those of one time
  PastOfDegree(const Vector& times, Matrix& past, int degree, Index first, Index count)
      : times_(times), past_(past), degree_(degree), first_(first), count_(count) {}

  /// Keeps the latest times that tell a smooth motion, and has the polynomial through them tell of the earlier ones.
  void smooth() {
    const double ahead = -times_[0];
    Index kept = 1;
    Matrix continued = polynomial(1, ahead);
    double added = continued.norm();
    while (kept < times_.size()) {
      Matrix next = polynomial(kept + 1, ahead);
      const double more = (next - continued).norm();
      if (!(more <= added)) break;
      added = more;
      continued = std::move(next);
      ++kept;
    }
    for (Index j = 0; j < times_.size() - kept; ++j) at(j) = polynomial(kept, times_[j]);
  }

 private:
  [[nodiscard]] Eigen::Block<Matrix> at(Index j) {
    const Index n_columns = past_.cols() / times_.size();
    return past_.block(coefficient_index(degree_, -degree_), j * n_columns + first_, 2 * degree_ + 1, count_);
  }
  /// At x, through now and this many of the latest times.
  [[nodiscard]] Matrix polynomial(Index n_latest, double x) {
    const Vector weights = weights_from_zero(times_.tail(n_latest), x);
    Matrix sum = Matrix::Zero(2 * degree_ + 1, count_);
    for (Index j = 0; j < n_latest; ++j) sum += weights[j] * at(times_.size() - n_latest + j);
    return sum;
  }

  const Vector& times_;
  Matrix& past_;
  int degree_;
  Index first_, count_;
};

}  // namespace

Matrix smooth_past(const Vector& times, Matrix past) {
  const Index n_columns = past.cols() / times.size();
  const int order = order_of(past.rows());
  for (int degree = 0; degree <= order; ++degree) {
    PastOfDegree(times, past, degree, 0, 3).smooth();
    for (Index column = 3; column < n_columns; ++column) PastOfDegree(times, past, degree, column, 1).smooth();
  }
  return past;
}

}  // namespace vehd
