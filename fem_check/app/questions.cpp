#include "fem_check/app/questions.hpp"

#include <cmath>

#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

/// Root mean square over γ.
double mean_size(const Eigen::MatrixXd& coefficients, const SurfacePoints& points) {
  if (coefficients.size() == 0) return 0.0;
  const Eigen::MatrixXd values = SurfaceSeries(coefficients)(points);
  return std::sqrt(values.colwise().squaredNorm().dot(points.weight) / points.weight.sum());
}

class Questions {
 public:
  Questions(const CheckInput& input, const SurfacePoints& points, double solver_tolerance)
      : input_(input), points_(points), solver_tolerance_(solver_tolerance) {}

  void on_surface(const std::string& name, const std::string& label, Eigen::MatrixXd BieFields::*field, double size) {
    if ((input_.bie.*field).size() == 0) return;
    FieldQuestion question = base(name, label, name, size);
    question.bie = SurfaceSeries(input_.bie.*field)(points_);
    question.bie_high = SurfaceSeries(input_.bie_high.*field)(points_);
    question.weight = points_.weight;
    list.push_back(std::move(question));
  }

  /// Three questions: inside, outside and near γ.
  void at_samples(const std::string& name, const std::string& symbol, Eigen::MatrixXd BieFields::*field, double size) {
    if ((input_.bie.*field).size() == 0) return;
    const Samples& samples = input_.samples;
    group(name + "_inside", symbol + " inside", name, field, size,
          [&](std::size_t i) { return !samples.near[i] && samples.inside[i]; });
    group(name + "_outside", symbol + " outside", name, field, size,
          [&](std::size_t i) { return !samples.near[i] && !samples.inside[i]; });
    group(name + "_near", symbol + " near", name, field, size, [&](std::size_t i) { return samples.near[i]; });
  }

  std::vector<FieldQuestion> list;

 private:
  [[nodiscard]] FieldQuestion base(const std::string& name, const std::string& label, const std::string& values,
                                   double size) const {
    FieldQuestion question;
    question.name = name;
    question.label = label;
    question.values = values;
    question.natural_size = size;
    question.solver_tolerance = solver_tolerance_;
    return question;
  }

  template <typename Belongs>
  void group(const std::string& name, const std::string& label, const std::string& values,
             Eigen::MatrixXd BieFields::*field, double size, const Belongs& belongs) {
    FieldQuestion question = base(name, label, values, size);
    question.is_sample = true;
    for (std::size_t i = 0; i < input_.samples.near.size(); ++i) {
      if (belongs(i)) question.columns.push_back(static_cast<Eigen::Index>(i));
    }
    if (question.columns.empty()) return;
    question.bie = (input_.bie.*field)(question.columns, Eigen::all).transpose();
    question.bie_high = (input_.bie_high.*field)(question.columns, Eigen::all).transpose();
    question.weight = Vector::Ones(static_cast<Eigen::Index>(question.columns.size()));
    list.push_back(std::move(question));
  }

  const CheckInput& input_;
  const SurfacePoints& points_;
  double solver_tolerance_;
};

}  // namespace

std::vector<FieldQuestion> electric_questions(const CheckInput& input, const SurfacePoints& points, double radius,
                                              const Refinement& refinement) {
  const double potential = input.physics.field.norm() * radius + mean_size(input.potential, points);
  const double field = potential / radius;
  Questions questions(input, points, refinement.potential_tolerance);
  questions.on_surface("q", "q", &BieFields::charge, field);
  questions.on_surface("Vm", "V_m steady", &BieFields::steady_potential, potential);
  questions.on_surface("q_steady", "q steady", &BieFields::steady_charge, field);
  questions.on_surface("force", "f_E", &BieFields::force_electric, input.physics.permittivity_out * field * field);
  questions.at_samples("potential", "phi", &BieFields::sample_potential, potential);
  return std::move(questions.list);
}

std::vector<FieldQuestion> flow_questions(const CheckInput& input, const SurfacePoints& points, double radius,
                                          const Refinement& refinement) {
  const Physics& physics = input.physics;
  const double velocity =
      physics.flow_gradient.norm() * radius + mean_size(input.force, points) * radius / physics.viscosity_out;
  Questions questions(input, points, refinement.flow_tolerance);
  questions.on_surface("velocity", "v", &BieFields::velocity, velocity);
  questions.on_surface("velocity_own_force", "v, own f_E", &BieFields::velocity_own_force, velocity);
  questions.at_samples("velocity", "v", &BieFields::sample_velocity, velocity);
  return std::move(questions.list);
}

}  // namespace vehd::fem_check
