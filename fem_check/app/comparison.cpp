#include "fem_check/app/comparison.hpp"

#include <algorithm>
#include <cmath>

namespace vehd::fem_check {
namespace {

/// A field below this share of its natural size counts as zero: its difference is taken relative to that.
constexpr double negligible = 1e-6;
/// Error of a solution over the residual at which its solver stops.
constexpr double solver_amplification = 10.0;
/// Slowest power of the radius with which the error of the outer sphere falls: with u = 0 there.
constexpr double slowest_truncation_order = 3.0;

/// The whole error of the nearer sphere over what moving it out changes.
double truncation_tail(const LevelSequence& sequence) {
  const double ratio = sequence.levels[sequence.repeated].outer_radius / sequence.far.outer_radius;
  return 1.0 / (1.0 - std::pow(ratio, slowest_truncation_order));
}

Eigen::MatrixXd selected(const Eigen::MatrixXd& values, const std::vector<Eigen::Index>& columns) {
  return columns.empty() ? values : Eigen::MatrixXd(values(Eigen::all, columns));
}

class Measure {
 public:
  explicit Measure(const FieldQuestion& question) : weight_(question.weight) {
    const double smallest = negligible * question.natural_size;
    l2_ = std::max(norm(question.bie_high), smallest * std::sqrt(weight_.sum()));
    max_ = std::max(largest(question.bie_high), smallest);
  }
  [[nodiscard]] Norms operator()(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) const {
    return {norm(a - b) / l2_, largest(a - b) / max_};
  }
  /// An absolute root mean square as a relative one.
  [[nodiscard]] double relative(double size) const { return size * std::sqrt(weight_.sum()) / l2_; }

 private:
  [[nodiscard]] double norm(const Eigen::MatrixXd& field) const {
    return std::sqrt(field.colwise().squaredNorm() * weight_);
  }
  [[nodiscard]] static double largest(const Eigen::MatrixXd& field) { return field.colwise().norm().maxCoeff(); }

  const Vector& weight_;
  double l2_, max_;
};

}  // namespace

FieldComparison compare(const FieldQuestion& question, const LevelSequence& sequence) {
  FieldComparison result;
  result.name = question.name;
  result.label = question.label;
  const Measure measure(question);
  const auto values_of = [&](const Level& level) {
    const FieldValues& fields = question.is_sample ? level.samples : level.surface;
    const auto found = fields.find(question.values);
    return found == fields.end() ? Eigen::MatrixXd() : selected(found->second, question.columns);
  };
  std::vector<Eigen::MatrixXd> values;
  std::vector<double> n_unknowns;
  for (const Level& level : sequence.levels) {
    values.push_back(values_of(level));
    if (values.back().size() == 0) {
      values.pop_back();
      continue;
    }
    n_unknowns.push_back(static_cast<double>(level.n_unknowns));
    result.of_levels.push_back(measure(values.back(), question.bie_high));
  }
  const std::size_t last = values.size() - 1;
  result.difference = result.of_levels.back();
  result.levels_change = measure(values[last], values[last - 1]);
  const Eigen::MatrixXd far = values_of(sequence.far);
  if (far.size() > 0) {
    const double tail = truncation_tail(sequence);
    const Norms change = measure(far, values_of(sequence.levels[sequence.repeated]));
    result.truncation = {tail * change.l2, tail * change.max};
  }
  result.solver = measure.relative(solver_amplification * question.solver_tolerance * question.natural_size);
  result.bie_change = measure(question.bie, question.bie_high);
  if (values.size() >= 3) {
    const double before = measure(values[last - 1], values[last - 2]).l2;
    if (result.levels_change.l2 > 0.0 && before > 0.0) {
      result.order =
          3.0 * std::log(before / result.levels_change.l2) / std::log(n_unknowns[last - 1] / n_unknowns[last - 2]);
    }
  }
  return result;
}

}  // namespace vehd::fem_check
