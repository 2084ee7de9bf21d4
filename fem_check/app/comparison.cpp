#include "fem_check/app/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

namespace vehd::fem_check {
namespace {

/// Rounding error relative to the natural size of a field: that of x times the fourth power of degree 48 for the
/// derivatives in f_b.
constexpr double rounding = 1e-9;
/// Error left by a solver tolerance, over its value if errors decreased like residuals.
constexpr double solver_factor = 10.0;
/// Error left by a solver tolerance, over the change when the tolerance is made loose_factor times larger.
constexpr double solver_share = solver_factor / loose_factor;
/// Lowest order of convergence in the mesh size that is assumed for levels.
constexpr double slowest_order = 1.0;
/// If levels differ by more than this fraction of the field, the observed order is not used.
constexpr double largest_change_with_an_order = 0.1;
/// Highest assumed order of convergence of boundary integrals in the degree: doubling the degree leaves a sixteenth of
/// the error.
constexpr double highest_degree_order = 4.0;

/// Error of the last level over the change to it, if errors are a power of the mesh size N^(−1/3); at least 1, since a
/// high order is inferred from two changes only.
/// @param growth  number of unknowns over that of the level before
double order_tail(double order, double growth) {
  return std::max(1.0, 1.0 / (std::pow(growth, std::max(order, slowest_order) / 3.0) - 1.0));
}

/// @param changes  of the last two levels, relative to the field
/// @param n_unknowns  of the last three levels
std::optional<Convergence> convergence(const std::array<double, 2>& changes, const std::array<double, 3>& n_unknowns) {
  if (!(changes[0] > 0.0 && changes[1] > 0.0)) return {};
  Convergence result;
  result.order = 3.0 * std::log(changes[0] / changes[1]) / std::log(n_unknowns[1] / n_unknowns[0]);
  const bool shows_order = changes[1] <= largest_change_with_an_order;
  result.tail = order_tail(shows_order ? result.order : slowest_order, n_unknowns[2] / n_unknowns[1]);
  return result;
}

/// Error e_p of the lower of two degrees p < P if errors decrease geometrically, e_n = r^n of the field, and e_p − e_P
/// is the change: slow decay, from an error at degree 0 as large as the field. A change too large for any r gives ≥ 1.
double error_of_slow_decay(double change, double growth) {
  // Solves e − e^growth = change below the maximum of the left side.
  const double largest = std::pow(growth, -1.0 / (growth - 1.0));
  if (change >= largest - std::pow(largest, growth)) return std::max(1.0, change);
  double low = 0.0, high = largest;
  for (int halving = 0; halving < std::numeric_limits<double>::digits; ++halving) {
    const double middle = 0.5 * (low + high);
    (middle - std::pow(middle, growth) < change ? low : high) = middle;
  }
  return high;
}

/// Error of the judged degree over the change to the other one, which has an error too: from the decay of the
/// coefficients, no slower than error_of_slow_decay, no faster than a power of the degree, and at least 1.
double degree_tail(double change, const Degrees& degrees) {
  if (!(change > 0.0) || degrees.judged == degrees.other) return 1.0;
  const double growth =
      static_cast<double>(std::max(degrees.judged, degrees.other)) / std::min(degrees.judged, degrees.other);
  double of_lower = error_of_slow_decay(change, growth) / change;
  if (degrees.decay && *degrees.decay < 1.0) of_lower = std::min(of_lower, 1.0 / (1.0 - *degrees.decay));
  of_lower = std::max(of_lower, 1.0 / (1.0 - std::pow(growth, -highest_degree_order)));
  return std::max(1.0, degrees.judged < degrees.other ? of_lower : of_lower - 1.0);
}

/// Field of a level in the form in which it is compared; empty if the level does not have it.
Eigen::MatrixXd values_of(const ComparedField& compared, const Level& level) {
  const FieldValues& fields = compared.is_sample ? level.samples : level.surface;
  const auto found = fields.find(compared.values);
  if (found == fields.end()) return {};
  Eigen::MatrixXd values = found->second;
  if (!compared.columns.empty()) values = Eigen::MatrixXd(values(Eigen::all, compared.columns));
  return compared.from_level ? compared.from_level(values) : values;
}

/// Norms relative to the larger of the judged field and its reference, so that neither hides the other, but at least to
/// the size below which a field counts as zero.
class Measure {
 public:
  Measure(const ComparedField& compared, const Eigen::MatrixXd& by, double required) : weight_(compared.weight) {
    const double share = compared.is_remainder ? 1.0 : required;
    const double least = std::max({share * compared.natural_size, compared.whole_size, least_number});
    l2_ = least * std::sqrt(weight_.sum());
    max_ = least;
    if (compared.is_remainder) return;
    l2_ = std::max({norm(compared.judged), norm(by), l2_});
    max_ = std::max({largest(compared.judged), largest(by), max_});
  }
  [[nodiscard]] Norms operator()(const Eigen::MatrixXd& difference) const {
    return {norm(difference) / l2_, largest(difference) / max_};
  }
  /// A root mean square relative to the same size.
  [[nodiscard]] double share_of(double size) const { return size * std::sqrt(weight_.sum()) / l2_; }

 private:
  [[nodiscard]] double norm(const Eigen::MatrixXd& field) const {
    return std::sqrt(field.colwise().squaredNorm() * weight_);
  }
  [[nodiscard]] static double largest(const Eigen::MatrixXd& field) { return field.colwise().norm().maxCoeff(); }

  static constexpr double least_number = std::numeric_limits<double>::min();
  const Vector& weight_;
  double l2_, max_;
};

Verdict verdict_of(const FieldComparison& field, double required) {
  // Written so that NaN gives disagree.
  if (!(field.difference.l2 <= field.fem_error() + field.bie_error())) return Verdict::disagree;
  const bool precise = field.fem_error() <= required && field.bie_error() <= required;
  return precise ? Verdict::agree : Verdict::undecided;
}

/// Compares with the levels that have the field.
void compare_with_levels(const ComparedField& compared, const LevelSequence& sequence, const Measure& measure,
                         const std::vector<Eigen::MatrixXd>& values, const std::vector<double>& n_unknowns,
                         FieldComparison& result) {
  for (const Eigen::MatrixXd& of_level : values) result.of_levels.push_back(measure(compared.judged - of_level));
  const std::size_t last = values.size() - 1;
  result.difference = result.of_levels.back();
  // A single level gives no estimate of its error.
  const double unknown = std::numeric_limits<double>::infinity();
  result.levels_change = last > 0 ? measure(values[last] - values[last - 1]) : Norms{unknown, unknown};
  const Level& repeated = sequence.levels[static_cast<std::size_t>(sequence.repeated)];
  const Eigen::MatrixXd truncated = values_of(compared, sequence.truncated);
  if (truncated.size() > 0) result.truncation = measure(truncated - values_of(compared, repeated));
  const Eigen::MatrixXd loose = values_of(compared, sequence.loose);
  if (loose.size() > 0) {
    result.solver = solver_share * measure(loose - values_of(compared, repeated)).l2;
  }
  result.solver += measure.share_of(compared.natural_size * compared.solver_magnification * sequence.tolerance);
  if (values.size() < 3) return;
  const auto found = convergence({measure(values[last - 1] - values[last - 2]).l2, result.levels_change.l2},
                                 {n_unknowns[last - 2], n_unknowns[last - 1], n_unknowns[last]});
  if (!found) return;
  result.order = found->order;
  result.tail = found->tail;
}

}  // namespace

const char* name_of(Verdict verdict) {
  if (verdict == Verdict::agree) return "agree";
  return verdict == Verdict::disagree ? "disagree" : "undecided";
}

std::optional<Convergence> convergence_of(const LevelSequence& sequence, const std::string& field) {
  const auto& levels = sequence.levels;
  if (levels.size() < 3) return {};
  const auto last_three = std::span(levels).last<3>();
  const double size = last_three[2].surface.at(field).norm();
  const auto change = [&](std::size_t i) {
    return (last_three[i + 1].surface.at(field) - last_three[i].surface.at(field)).norm() / size;
  };
  const auto unknowns = [&](std::size_t i) { return static_cast<double>(last_three[i].n_unknowns); };
  return convergence({change(0), change(1)}, {unknowns(0), unknowns(1), unknowns(2)});
}

FieldComparison compare(const ComparedField& compared, const LevelSequence& sequence, const Requirement& required) {
  FieldComparison result;
  result.name = compared.name;
  result.label = compared.label;
  result.group = compared.group;
  result.reference = compared.reference;
  result.has_work_row = compared.has_work_row;
  std::vector<Eigen::MatrixXd> values;
  std::vector<double> n_unknowns;
  for (const Level& level : sequence.levels) {
    Eigen::MatrixXd of_level =
        compared.reference == Reference::elements ? values_of(compared, level) : Eigen::MatrixXd();
    if (of_level.size() == 0) continue;
    values.push_back(std::move(of_level));
    n_unknowns.push_back(static_cast<double>(level.n_unknowns));
  }
  if (values.empty() && compared.reference == Reference::elements) {
    throw std::logic_error("no level has the values \"" + compared.values + "\" of " + compared.name);
  }
  const Measure measure(compared, values.empty() ? compared.bie : values.back(), required.error);
  if (values.empty()) {
    result.difference = measure(compared.judged - compared.bie);
  } else {
    compare_with_levels(compared, sequence, measure, values, n_unknowns, result);
  }
  result.bie_change = measure(compared.bie - compared.bie_high);
  result.bie_tail = degree_tail(result.bie_change.l2, compared.degrees);
  if (compared.further_error.size() > 0) result.bie_further = measure(compared.further_error).l2;
  if (compared.time_error.size() > 0) result.time = measure(compared.time_error).l2;
  result.floor =
      measure.share_of(compared.natural_size * std::max(rounding, solver_factor * required.solver_tolerance));
  result.verdict = verdict_of(result, required.error);
  return result;
}

}  // namespace vehd::fem_check
